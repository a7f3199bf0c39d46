//! A web page served on this machine, on which a person answers.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::io::{self, Read};
use std::time::{Duration, Instant};

use tiny_http::{Header, Method, Request, Response, Server};

use crate::error::{Error, Result};

/// Longest accepted answer, bytes.
const LONGEST_ANSWER: u64 = 1 << 16;

/// A file of the page.
#[derive(Clone, Debug)]
pub struct ServedFile {
    /// Its name in the page's folder; empty for the page itself.
    pub name: &'static str,
    /// Its media type, such as `image/png`.
    pub media_type: &'static str,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// Response to something that the page sent.
#[derive(Clone, Debug)]
pub enum Reply<T> {
    /// It is the answer; the page is no longer needed.
    Answered(T),
    /// This text is returned to the page.
    Text(String),
    /// It is refused for this reason.
    Refused(String),
}

/// Serves files to this machine only, at an unguessable address, until the page has sent an answer; none if
/// nobody answers in time.
///
/// # Arguments
/// - `files`: the page and the files that it requests.
/// - `wait`: time limit for the answer.
/// - `open`: shows the page at this address to the person.
/// - `reply`: the response to a text sent by the page to a name, such as `done`.
///
/// # Errors
/// [`Error::File`] if no page can be served.
///
/// # Example
/// ```
/// use std::io::{Read, Write};
/// use std::{net::TcpStream, thread, time::Duration};
/// use vfold::cli::{Reply, ServedFile, ask_on_page};
/// let page = ServedFile { name: "", media_type: "text/html", bytes: b"Well?".to_vec() };
/// // a browser that posts 42 to the page's `done`
/// let browse = |address: &str| {
///     let (host, folder) = address.strip_prefix("http://").unwrap().split_once('/').unwrap();
///     let mut stream = TcpStream::connect(host).unwrap();
///     write!(stream, "POST /{folder}done HTTP/1.1\r\nHost: {host}\r\nContent-Length: 2\r\n\r\n42").unwrap();
///     thread::spawn(move || stream.read_to_string(&mut String::new()));
/// };
/// let reply =
///     |_: &str, text: &str| text.parse().map_or(Reply::Refused("a number!".to_owned()), Reply::Answered);
/// let answer: Option<u8> = ask_on_page(&[page], Duration::from_secs(60), browse, reply)?;
/// assert_eq!(answer, Some(42));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn ask_on_page<T>(
    files: &[ServedFile],
    wait: Duration,
    open: impl FnOnce(&str),
    mut reply: impl FnMut(&str, &str) -> Reply<T>,
) -> Result<Option<T>> {
    let unserved = |error| Error::file("the page", error);
    let server = Server::http(("127.0.0.1", 0)).map_err(|error| unserved(io::Error::other(error)))?;
    let folder = format!("/{}/", unguessable());
    open(&format!("http://{}{folder}", server.server_addr()));
    let end = Instant::now() + wait;
    loop {
        let left = end.saturating_duration_since(Instant::now());
        let Some(mut request) = server.recv_timeout(left).map_err(unserved)? else { return Ok(None) };
        let Some(name) = request.url().strip_prefix(&folder).map(str::to_owned) else {
            send(request, 404, "text/plain", b"");
            continue;
        };
        if *request.method() == Method::Get {
            match files.iter().find(|file| file.name == name) {
                Some(file) => send(request, 200, file.media_type, &file.bytes),
                None => send(request, 404, "text/plain", b""),
            }
            continue;
        }
        let mut text = String::new();
        if request.as_reader().take(LONGEST_ANSWER).read_to_string(&mut text).is_err() {
            send(request, 400, "text/plain", b"not text in UTF-8");
            continue;
        }
        match reply(&name, &text) {
            Reply::Answered(answer) => {
                send(request, 200, "text/plain", b"");
                return Ok(Some(answer));
            }
            Reply::Text(text) => send(request, 200, "text/plain", text.as_bytes()),
            Reply::Refused(why) => send(request, 400, "text/plain", why.as_bytes()),
        }
    }
}

/// 128 bits from the operating system's seeds for hash tables, which no other page in the browser can guess.
fn unguessable() -> String {
    let number = || RandomState::new().build_hasher().finish();
    format!("{:016x}{:016x}", number(), number())
}

/// Sends a response; a page that has closed is ignored.
fn send(request: Request, status: u16, media_type: &str, bytes: &[u8]) {
    let header = |name: &str, value: &str| Header::from_bytes(name, value).ok();
    let headers = [header("Content-Type", media_type), header("Cache-Control", "no-store")];
    let response = Response::from_data(bytes).with_status_code(status);
    let response = headers.into_iter().flatten().fold(response, Response::with_header);
    let _ = request.respond(response);
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;

    #[test]
    fn nobody_waits_for_ever() {
        let asked = ask_on_page(&[], Duration::ZERO, |_| (), |_, _| Reply::Answered(()));
        assert_eq!(asked.unwrap(), None);
    }

    #[test]
    fn two_pages_have_two_addresses() {
        assert!(unguessable() != unguessable() && unguessable().len() == 32);
    }
}
