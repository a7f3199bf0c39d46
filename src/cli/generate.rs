//! Output of `--generate`: a tool's man page and completions from its own flags; page and schema of the
//! stream from its types.

use std::io;

use clap::builder::PossibleValuesParser;
use clap::{Command, ValueEnum};
use clap_complete::Shell;
use clap_mangen::Man;
use roff::{Roff, bold, roman};

use super::stream_page::stream_page;
use crate::error::{Error, Result};
use crate::spectrum::library::{What, built_in};
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
    /// Prints it for the tool `command`.
    ///
    /// # Errors
    /// [`Error::Output`] if it cannot be written.
    pub(super) fn print(self, command: Command, out: &mut Output) -> Result<()> {
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
        clap_complete::generate(shell, &mut with_names(command)?, name, &mut text);
        out.text(&with_files(String::from_utf8_lossy(&text).into_owned(), shell)?)
    }
}

/// Flags that take a built-in spectrum by name, or a file.
const NAMED: [(What, &[&str]); 3] = [
    (What::Cameras, &["camera"]),
    (What::Illuminants, &["illuminant", "sky_illuminant"]),
    (
        What::Reflectances,
        &["reflectance", "truth", "reference_panel", "chart_reference", "white_reflectance"],
    ),
];

/// The command with the possible names of these flags.
fn with_names(mut command: Command) -> Result<Command> {
    for (what, flags) in NAMED {
        let names = built_in(what)?;
        for flag in flags {
            if command.get_arguments().any(|arg| arg.get_id() == *flag) {
                let names = PossibleValuesParser::new(names.clone());
                command = command.mut_arg(flag, |arg| arg.value_parser(names));
            }
        }
    }
    Ok(command)
}

/// Completions in which these flags also take files: clap offers names or files, not both.
fn with_files(mut text: String, shell: Shell) -> Result<String> {
    for (what, _) in NAMED {
        let names = built_in(what)?;
        let list = names.join(" ");
        let first = names.first().map(String::as_str).unwrap_or_default();
        text = match shell {
            Shell::Bash => text.replace(&format!("-W \"{list}\""), &format!("-f -W \"{list}\"")),
            Shell::Zsh => {
                let both = format!(":{{_alternative \"names\\:name\\:({list})\" \"files\\:file\\:_files\"}}");
                text.replace(&format!(":({list})"), &both)
            }
            _ => text.replace(&format!("-f -a \"{first}"), &format!("-F -a \"{first}")),
        };
    }
    Ok(text)
}

/// The synopsis in one line: all flags are below.
fn synopsis(page: &mut Roff, command: &Command) {
    let mut parts = vec![bold(command.get_name()), roman(" [OPTIONS]")];
    for argument in command.get_positionals() {
        let name = argument.get_value_names().map(|names| names.join(" ")).unwrap_or_default();
        let several =
            if argument.get_num_args().is_some_and(|count| count.max_values() > 1) { "..." } else { "" };
        parts.push(roman(format!(" [{name}]{several}")));
    }
    page.control("SH", ["SYNOPSIS"]).text(parts);
}

/// The sections of man-pages(7), in its order; the text after the options of `--help` is EXAMPLES up to its
/// first empty line, then NOTES.
fn man_page(command: Command, page: &mut Vec<u8>) -> io::Result<()> {
    let title = command.get_name().to_uppercase();
    let help_end = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let (examples, notes) = help_end.split_once("\n\n").unwrap_or((&help_end, ""));
    let mut short = Roff::new();
    synopsis(&mut short, &command);
    // no date, which would be outdated tomorrow
    let man = Man::new(command)
        .title(title)
        .date("\"\"")
        .source(concat!("vfold ", env!("CARGO_PKG_VERSION")))
        .manual("vfold");
    man.render_title(page)?;
    man.render_name_section(page)?;
    short.to_writer(page)?;
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

/// A section with unfilled lines.
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
