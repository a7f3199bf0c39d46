//! What the benchmarks share: a clock, one thread, a fold, and a line about the machine.

use std::hint::black_box;
use std::path::PathBuf;
use std::process::Command;
use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};
use vfold::geometry::{FacetGrid, Fold};

/// Most runs of one work.
const RUNS_MAX: usize = 31;
/// After the first time three runs are enough, after the second one is.
const LONG_ENOUGH: [Duration; 2] = [Duration::from_millis(300), Duration::from_secs(2)];

/// Median time of `work` in milliseconds, and what it gave. Time is the processor's, which on one thread is
/// that of an idle machine whatever else runs beside it.
pub fn timed<T>(mut work: impl FnMut() -> T) -> (f64, T) {
    let (begin, mut times) = (Instant::now(), Vec::new());
    loop {
        let (ms, result) = timed_once(&mut work);
        times.push(ms);
        let [three, one] = LONG_ENOUGH.map(|time| begin.elapsed() > time);
        if times.len() == RUNS_MAX || (three && times.len() >= 3) || one {
            times.sort_by(f64::total_cmp);
            return (times[times.len() / 2], result);
        }
    }
}

/// Time of one run in milliseconds, and what it gave.
pub fn timed_once<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = processor_time();
    let result = black_box(work());
    (1e3 * processor_time().saturating_sub(start).as_secs_f64(), result)
}

fn processor_time() -> Duration {
    Duration::try_from(clock_gettime(ClockId::ProcessCPUTime)).unwrap_or_default()
}

/// Everything after this runs on one thread.
pub fn on_one_thread() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().unwrap();
}

/// A fold of square panels with `n` x `n` facets each.
pub fn fold(angle_deg: f64, n: usize) -> Fold {
    Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: n, cols: n }).unwrap()
}

/// Where results are kept.
pub fn results(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "benches/results", name].iter().collect()
}

/// Processor, compiler, version and date.
pub fn machine() -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let cpu = cpu.lines().find_map(|line| line.strip_prefix("model name")).unwrap_or("an unknown processor");
    let said = |program: &str, flag: &str| {
        let output = Command::new(program).arg(flag).output().map(|output| output.stdout);
        String::from_utf8(output.unwrap_or_default()).unwrap_or_default().trim().to_owned()
    };
    let (rustc, date) = (said("rustc", "--version"), said("date", "+%F"));
    format!(
        "vfold {}, {rustc}, one thread of {}, {date}",
        env!("CARGO_PKG_VERSION"),
        cpu.trim_start_matches([' ', '\t', ':'])
    )
}
