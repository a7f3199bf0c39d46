//! The frame of every tool: common flags, exit status, broken pipes, complete files or none.

mod generate;
mod kernel;
mod materials;
mod notes;
mod outcome;
mod served;
mod spectra;
mod stream_page;
mod surplus;

use std::num::NonZero;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser};

pub use kernel::KernelArgs;
pub use materials::MaterialArgs;
use notes::Notes;
pub use served::{Reply, ServedFile, ask_on_page};
pub use surplus::refuse;

use crate::error::{Error, Result, counted};
use crate::files::Together;
pub use crate::message::one_line;
use crate::message::printable;
pub use crate::progress::say;
use crate::progress::{Progress, When};
use crate::room;
use crate::spectrum::library::{What, list};
use crate::spectrum::{ASSUMED_LIGHT, Sensitivities, Spectrum, UNKNOWN_LIGHT, WavelengthGrid};
use crate::stream::{Failures, Optics, Output};
pub use generate::Generate;
use outcome::{misuse, without_panic};

/// Flags that all tools have.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Write to FILE instead of standard output; it appears when it is complete
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Like --output, but write line by line, and resume an interrupted run of the same command
    #[arg(long, value_name = "FILE", conflicts_with = "output")]
    pub resume: Option<PathBuf>,
    /// Threads to use, 1 to 1024 [default: all cores]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
    /// Report what was decided, measured and skipped
    #[arg(short, long, conflicts_with = "quiet")]
    pub verbose: bool,
    /// Show on standard error the samples done, the rate and the time left; auto: on a terminal, when the
    /// records go to a file
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub progress: When,
    /// Also write a field of the records as an NPY array, samples stacked
    #[arg(long, value_name = "FIELD=FILE", value_parser = field_and_file)]
    pub save: Vec<(String, PathBuf)>,
    /// Do not record this tool's arguments in the stream
    #[arg(long)]
    pub no_history: bool,
    /// Print the man page, a shell's completions, or the man page or JSON Schema of the records
    #[arg(long, value_name = "WHAT")]
    pub generate: Option<Generate>,
    /// Print the built-in spectra of a kind, and your own in the directory VFOLD_DATA
    #[arg(long, value_name = "WHAT")]
    pub list: Option<What>,
    /// Read files of reflectances without a stated unit as percent, or, with --percent=no, as fractions
    /// [default: as percent if a value is above 2]
    #[arg(long, value_name = "yes|no", num_args = 0..=1, require_equals = true, default_missing_value = "yes",
        value_parser = clap::builder::BoolishValueParser::new(), hide_possible_values = true)]
    pub percent: Option<bool>,
    #[arg(skip)]
    notes: Notes,
}

impl Common {
    /// When to show progress: `--quiet` means never.
    fn when(&self) -> When {
        if self.quiet { When::Never } else { self.progress }
    }
}

/// Runs one tool and turns its outcome into an exit status; `common` are those of its flags that all tools
/// have.
///
/// 0: done, or the reader closed the pipe. 1: stopped by bad data or I/O. 2: wrong usage. 3: finished, but
/// some records carry an `error`; standard error states how many, and the first reason. An [empty
/// pipe](Error::EmptyPipe) causes no message.
pub fn run<A: Parser>(
    common: fn(&A) -> &Common,
    tool: impl FnOnce(&A, &mut Output) -> Result<()>,
) -> ExitCode {
    let done = match parsed::<A>() {
        Ok(args) => without_panic(|| frame(common(&args), A::command(), |out| tool(&args, out))),
        Err(help) if !help.use_stderr() => help.print().map(|()| Failures::default()).map_err(Error::Output),
        Err(error) => {
            let name = A::command().get_name().to_owned();
            say(&name, &format!("{}; see {name} --help", misuse(&error.render().to_string())));
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(failures) if failures.any() => {
            say(A::command().get_name(), &failures.to_string());
            ExitCode::from(3)
        }
        Ok(_) => ExitCode::SUCCESS,
        Err(e) if e.is_broken_pipe() => ExitCode::SUCCESS,
        // a failed pipeline prints one line, from the tool that failed
        Err(Error::EmptyPipe) => ExitCode::FAILURE,
        Err(e) => {
            say(A::command().get_name(), &e.to_string());
            ExitCode::from(e.exit_status())
        }
    }
}

/// The tool's arguments. A negative number is the value of the flag before it, which refuses it in its own
/// words, and no flag itself.
fn parsed<A: Parser>() -> std::result::Result<A, clap::Error> {
    let with_negative = |arg: clap::Arg| {
        let takes_value = arg.get_action().takes_values() && !arg.is_positional();
        if takes_value { arg.allow_negative_numbers(true) } else { arg }
    };
    let mut matches = A::command().mut_args(with_negative).try_get_matches()?;
    A::from_arg_matches_mut(&mut matches).map_err(|error| error.format(&mut A::command()))
}

/// Runs the tool between opening and finishing its output; returns the samples that carry an error. No file
/// appears before all of the run's outputs are complete.
fn frame(
    common: &Common,
    command: clap::Command,
    tool: impl FnOnce(&mut Output) -> Result<()>,
) -> Result<Failures> {
    let name = command.get_name().to_owned();
    start_threads(common.threads)?;
    let together = Together::begin();
    let mut out = match &common.resume {
        Some(path) => Output::resume(path, &common.save, !common.no_history)?,
        None => Output::to(common.output.as_deref(), &common.save)?,
    };
    let to_file = common.output.is_some() || common.resume.is_some();
    out.show(Progress::new(&name, common.when(), to_file));
    let done = match (common.generate, common.list) {
        (Some(what), _) => what.print(command, &mut out),
        (None, Some(what)) => print_list(what, &mut out),
        (None, None) => tool(&mut out),
    };
    if done.as_ref().is_err_and(|e| !e.is_finding()) {
        return done.map(|()| Failures::default());
    }
    let failures = out.finish()?;
    match done {
        // the records that carry an error say why there is nothing to draw
        Err(e @ Error::NothingToDraw(_)) if failures.any() => {
            say(&name, &e.to_string());
            together.keep().map(|()| failures)
        }
        Err(e @ Error::NothingToDraw(_)) => Err(e),
        done => together.keep().and_then(|()| done.map(|()| failures)),
    }
}

/// Address space of a thread's stack, bytes.
const STACK: u64 = 2 << 20;
/// Other memory needed by any run: with less it would abort without a message.
const LEAST_ROOM: u64 = 32 << 20;

/// Starts this many threads, else as many as the environment states, else one per core.
fn start_threads(count: Option<u16>) -> Result<()> {
    let in_environment = || std::env::var("RAYON_NUM_THREADS").ok()?.parse().ok().filter(|count| *count > 0);
    let all = || std::thread::available_parallelism().map_or(1, NonZero::get);
    let count = count.map(usize::from).or_else(in_environment).unwrap_or_else(all);
    // running threads abort the program if the stack of a later one leaves them no memory
    let room = LEAST_ROOM.saturating_add(STACK.saturating_mul(count as u64));
    room::ask(room, &format!("a run on {}", counted(count, "thread")), "use fewer with --threads")?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count);
    pool.build_global().map_err(|error| {
        Error::Numeric(format!(
            "cannot start threads ({error}); use fewer with --threads, or allow more memory (ulimit -v)"
        ))
    })
}

fn print_list(what: What, out: &mut Output) -> Result<()> {
    let line = |(name, description): (String, String)| {
        format!("{:<20} {}", printable(&name), printable(&description))
    };
    list(what)?.into_iter().try_for_each(|entry| out.text(&line(entry)))
}

fn field_and_file(text: &str) -> std::result::Result<(String, PathBuf), String> {
    match text.split_once('=') {
        Some((_, "-")) => Err("an array needs a file: write FIELD=FILE.npy".to_owned()),
        Some((field, file)) if !field.is_empty() && !file.is_empty() => Ok((field.to_owned(), file.into())),
        _ => Err("write FIELD=FILE.npy".to_owned()),
    }
}

/// Parses the file name of a drawing.
///
/// # Errors
/// A message for the command line, if it ends neither in .svg nor in .png.
pub fn drawing(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).as_deref() {
        Some("svg" | "png") => Ok(path),
        _ => Err("end the name in .svg or .png".to_owned()),
    }
}

/// Parses the file name of a drawing, or `-` for the terminal.
///
/// # Errors
/// As [`drawing`].
pub fn drawing_or_terminal(text: &str) -> std::result::Result<PathBuf, String> {
    match text {
        "-" => Ok(text.into()),
        _ => drawing(text).map_err(|problem| format!("{problem}, or write - for the terminal")),
    }
}

/// Parses two numbers around an `x`, such as `10x10` or `1.5x1`.
///
/// # Errors
/// A message for the command line.
pub fn pair<T: std::str::FromStr>(text: &str) -> std::result::Result<(T, T), String> {
    let parse = |part: &str| part.trim().parse().ok();
    text.split_once(['x', 'X'])
        .and_then(|(a, b)| Some((parse(a)?, parse(b)?)))
        .ok_or_else(|| "write two numbers around an x, such as 10x10".to_owned())
}

/// Parses `X,Y,Z`, as in `--light 0,1,2`.
///
/// # Errors
/// What to write instead, if the text is not three finite numbers around commas.
///
/// # Example
/// ```
/// assert_eq!(vfold::cli::vector("0, -1,5e1"), Ok([0.0, -1.0, 50.0]));
/// assert!(vfold::cli::vector("1,2").is_err());
/// ```
pub fn vector(text: &str) -> std::result::Result<[f64; 3], String> {
    let parse = |part: &str| part.trim().parse().ok().filter(|x: &f64| x.is_finite());
    let numbers: Option<Vec<f64>> = text.split(',').map(parse).collect();
    numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| "write X,Y,Z, three numbers".to_owned())
}

/// Camera, illuminants and wavelengths: what looks at a fold.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Camera and light")]
pub struct OpticsArgs {
    /// Illuminant; each tool has a help text of its own for what it takes
    #[arg(long, value_name = "SPEC", value_parser = light)]
    pub illuminant: Vec<String>,
    /// Illuminant of the sky; sky: that of a cloudless day with the sun of --illuminant
    /// [default: the same as the sun's]
    #[arg(long, value_name = "SPEC", value_parser = light)]
    pub sky_illuminant: Option<String>,
    /// Wavelengths, nm: the first, the last and the step
    #[arg(long, value_name = "FIRST:LAST:STEP", default_value = "400:700:5", value_parser = wavelengths)]
    pub wavelengths_nm: WavelengthGrid,
}

/// Parses the SPEC of a light; a large number is refused, because it may be a temperature or the power of a
/// flat spectrum.
///
/// # Errors
/// Both readings, if the text is such a number.
///
/// # Example
/// ```
/// assert!(vfold::cli::light("2856").unwrap_err().contains("a black body (2856K)"));
/// assert_eq!(vfold::cli::light("2856K").as_deref(), Ok("2856K"));
/// assert_eq!(vfold::cli::light("1").as_deref(), Ok("1"));
/// ```
pub fn light(text: &str) -> std::result::Result<String, String> {
    /// No body shines visibly at so low a temperature, and no illuminant is named by so small a number, as
    /// D50 and D65 are by theirs.
    const POWER_MAX: f64 = 10.0;
    let number = text.trim();
    match number.parse() {
        Ok(value) if value > POWER_MAX && f64::is_finite(value) => {
            let black_body = if (1000.0..=25000.0).contains(&value) { number } else { "2856" };
            let daylight = if (4000.0..=25000.0).contains(&value) { number } else { "5500" };
            Err(format!(
                "a number may mean a black body ({black_body}K), daylight (daylight:{daylight}) or a flat \
                 spectrum (E, or 1): write which"
            ))
        }
        _ => Ok(text.to_owned()),
    }
}

fn wavelengths(text: &str) -> std::result::Result<WavelengthGrid, String> {
    let numbers: Option<Vec<f64>> = text.split(':').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some([first, last, step]) => WavelengthGrid::uniform(*first, *last, *step).map_err(|e| e.to_string()),
        _ => Err("write FIRST:LAST:STEP, such as 400:700:5".to_owned()),
    }
}

impl OpticsArgs {
    /// The only illuminant, for a tool that reads one picture.
    ///
    /// # Errors
    /// [`Error::Usage`] if there are several; `why` explains that the tool takes only one.
    pub fn one_illuminant(&self, why: &str) -> Result<&str> {
        match self.illuminant.as_slice() {
            [] => Ok(ASSUMED_LIGHT),
            [one] => Ok(one),
            several => Err(Error::usage("--illuminant", format!("{} illuminants", several.len()), why)),
        }
    }

    /// Refuses an unknown light where a tool needs it.
    ///
    /// # Errors
    /// [`Error::Usage`] if one of the illuminants is.
    pub fn known_illuminants(&self, why: &str) -> Result<()> {
        match self.illuminant.iter().chain(&self.sky_illuminant).any(|spec| spec == UNKNOWN_LIGHT) {
            true => Err(Error::usage("--illuminant", format!("'{UNKNOWN_LIGHT}' names no light"), why)),
            false => Ok(()),
        }
    }

    /// The spectra that the flags name, on the wavelength grid, with this camera. A camera's sensitivity is
    /// zero where it was not measured. Conversions are reported as `common` requires.
    ///
    /// # Errors
    /// As [`Common::illuminant`], or if an illuminant does not cover the wavelengths.
    pub fn resolve(&self, camera: &Sensitivities, common: &Common) -> Result<Optics> {
        let (illuminants, sky) = self.lights(common)?;
        Optics::new(self.wavelengths_nm.clone(), camera, &illuminants, sky.as_ref())
    }

    /// The illuminants that the flags name, empty if unknown, and that of the sky, if different.
    ///
    /// # Errors
    /// As [`Common::illuminant`].
    pub fn lights(&self, common: &Common) -> Result<(Vec<Spectrum>, Option<Spectrum>)> {
        let light = |spec: &String| common.illuminant(spec);
        let illuminants = match self.illuminant.as_slice() {
            [unknown] if unknown == UNKNOWN_LIGHT => Vec::new(),
            [] => vec![common.illuminant(ASSUMED_LIGHT)?],
            named => named.iter().map(light).collect::<Result<_>>()?,
        };
        Ok((illuminants, self.sky()?.as_ref().map(light).transpose()?))
    }

    /// The spectrum of the sky; `sky` alone belongs to the sun.
    fn sky(&self) -> Result<Option<String>> {
        match (self.sky_illuminant.as_deref(), self.illuminant.as_slice()) {
            (Some("sky"), [sun, ..]) if sun.starts_with("sun:") => Ok(Some(sun.replacen("sun:", "sky:", 1))),
            (Some("sky"), _) => {
                let problem = "'sky' needs a sun";
                let remedy =
                    "add --illuminant sun:40deg or sun:LAT,LON,TIME, or give --sky-illuminant sky:40deg";
                Err(Error::usage("--sky-illuminant", problem, remedy))
            }
            (spec, _) => Ok(spec.map(str::to_owned)),
        }
    }
}
