//! The commands that made a scene and its samples, as a shell takes them.

use crate::stream::HistoryRecord;

/// Flags that write files beside the records: what is pasted makes records, and overwrites nothing.
const FILES: [&str; 6] = ["--overlay", "--plot", "--report", "--spectra", "--trace", "--save"];

/// One pipe of the tools, a line each.
///
/// A tool that read a file reads the one before it here: files between the tools are often gone.
pub(super) fn pipeline(history: &[HistoryRecord]) -> String {
    let calls: Vec<String> = history.iter().map(call).collect();
    calls.join(" |\n  ")
}

fn call(line: &HistoryRecord) -> String {
    let mut words = vec![line.tool.clone()];
    let mut arguments = line.arguments.iter();
    while let Some(argument) = arguments.next() {
        let is_flag = |flag: &&str| {
            argument.strip_prefix(*flag).is_some_and(|rest| rest.is_empty() || rest.starts_with('='))
        };
        match FILES.iter().find(|flag| is_flag(flag)) {
            Some(flag) if argument == *flag => drop(arguments.next()),
            Some(_) => {}
            None => words.push(quoted(argument)),
        }
    }
    words.join(" ")
}

/// A word as a POSIX shell reads it.
fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./,:=@%+".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(tool: &str, arguments: &[&str]) -> HistoryRecord {
        let arguments = arguments.iter().map(|&argument| argument.to_owned()).collect();
        HistoryRecord { tool: tool.to_owned(), version: String::new(), arguments }
    }

    #[test]
    fn a_shell_reads_what_was_called() {
        let history = [
            line("vkernel", &["--angle-deg", "50"]),
            line("vextract", &["it's a photo.tif", "--overlay", "o.png", "--panel0", "1,2 3,4 5,6 7,8"]),
            line("vestimate", &["--spectra=s.csv", "--fit", "auto"]),
        ];
        let expected = "vkernel --angle-deg 50 |\n  \
                        vextract 'it'\\''s a photo.tif' --panel0 '1,2 3,4 5,6 7,8' |\n  \
                        vestimate --fit auto";
        assert_eq!(pipeline(&history), expected);
    }
}
