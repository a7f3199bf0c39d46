//! The commands that made a scene and its samples, in shell syntax.

use crate::stream::HistoryRecord;

/// One pipeline of the tools, one per line.
///
/// A tool that read a file reads it again; one that read standard input reads the output of the previous
/// tool.
pub(super) fn pipeline(history: &[HistoryRecord]) -> String {
    let call = |line: &HistoryRecord| {
        let words = std::iter::once(line.tool.clone()).chain(line.arguments.iter().map(|word| quoted(word)));
        words.collect::<Vec<_>>().join(" ")
    };
    history.iter().map(call).collect::<Vec<_>>().join(" |\n  ")
}

/// A word quoted for a POSIX shell.
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
            line("vextract", &["it's a photo.tif", "--panel0", "1,2 3,4 5,6 7,8", "--overlay", "o.png"]),
            line("vestimate", &["--spectra=s.csv", "--fit", "auto"]),
        ];
        let expected = "vkernel --angle-deg 50 |\n  \
                        vextract 'it'\\''s a photo.tif' --panel0 '1,2 3,4 5,6 7,8' --overlay o.png |\n  \
                        vestimate --spectra=s.csv --fit auto";
        assert_eq!(pipeline(&history), expected);
    }
}
