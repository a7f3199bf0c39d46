//! What `--generate` prints: a tool's man page and completions, from its own flags; page and schema of the stream, from its types.

use std::io;

use clap::{Command, ValueEnum};
use clap_complete::Shell;
use clap_mangen::Man;
use roff::{Roff, roman};

use super::stream_page::stream_page;
use crate::error::{Error, Result};
use crate::stream::{Output, schema};

/// What `--generate` prints.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Generate {
    /// The man page.
    Man,
    /// The man page vfold-stream(5): all fields of all records.
    Stream,
    /// JSON Schema of the records.
    Schema,
    /// Completions for bash.
    Bash,
    /// Completions for zsh.
    Zsh,
    /// Completions for fish.
    Fish,
}

const EXIT_STATUS: [(&str, &str); 4] = [
    ("0", "Done, or the reader of the output closed it."),
    ("1", "Stopped by bad data or by a file that cannot be read or written."),
    ("2", "Wrong usage."),
    ("3", "Finished, but some records carry an error."),
];
const SEE_ALSO: &str =
    "vfold(7), vfold-stream(5), vkernel(1), vextract(1), vforward(1), vestimate(1), vscore(1)";

impl Generate {
    /// Prints it for the tool that `command` is.
    ///
    /// # Errors
    /// [`Error::Output`] if it cannot be written.
    pub(super) fn print(self, mut command: Command, out: &mut Output) -> Result<()> {
        let name = command.get_name().to_owned();
        let mut text = Vec::new();
        let shell = match self {
            Self::Man => {
                man_page(command, &mut text).map_err(Error::Output)?;
                return out.text(&String::from_utf8_lossy(&text));
            }
            Self::Stream => return out.text(stream_page().trim_end()),
            Self::Schema => return out.text(&schema()),
            Self::Bash => Shell::Bash,
            Self::Zsh => Shell::Zsh,
            Self::Fish => Shell::Fish,
        };
        clap_complete::generate(shell, &mut command, name, &mut text);
        out.text(&String::from_utf8_lossy(&text))
    }
}

/// The sections of man-pages(7), in its order; what `--help` ends with is EXAMPLES up to its first empty line, then NOTES.
fn man_page(command: Command, page: &mut Vec<u8>) -> io::Result<()> {
    let title = command.get_name().to_uppercase();
    let help_end = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let (examples, notes) = help_end.split_once("\n\n").unwrap_or((&help_end, ""));
    // no date: pages would be stale by tomorrow
    let man = Man::new(command)
        .title(title)
        .date("\"\"")
        .source(concat!("vfold ", env!("CARGO_PKG_VERSION")))
        .manual("vfold");
    man.render_title(page)?;
    man.render_name_section(page)?;
    man.render_synopsis_section(page)?;
    man.render_description_section(page)?;
    man.render_options_section(page)?;
    let mut rest = Roff::new();
    rest.control("SH", ["EXIT STATUS"]);
    for (status, meaning) in EXIT_STATUS {
        rest.control("TP", []).text([roman(status)]).text([roman(meaning)]);
    }
    as_it_is(&mut rest, "NOTES", notes);
    as_it_is(&mut rest, "EXAMPLES", examples.trim_start_matches("Examples:\n"));
    rest.control("SH", ["SEE ALSO"]).text([roman(SEE_ALSO)]);
    rest.to_writer(page)
}

/// A section of lines that are not filled.
fn as_it_is(page: &mut Roff, title: &str, text: &str) {
    if text.is_empty() {
        return;
    }
    page.control("SH", [title]).control("nf", []);
    for line in text.lines() {
        page.text([roman(line)]);
    }
    page.control("fi", []);
}
