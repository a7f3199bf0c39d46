//! Whole runs of vkernel and their parts, one thread. Markdown goes to standard output and to `benches/results/timings.md`.

#![allow(clippy::unwrap_used, reason = "a measurement stops at the first surprise")]
#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]

#[path = "common/mod.rs"]
mod common;

use std::fmt::Write;
use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::{fold, machine, results, timed};
use vfold::kernel::exact::form_factors;
use vfold::kernel::mesh::{Mesh, respond};

const ANGLE_DEG: f64 = 45.0;
/// Facets along a side over which the growth of the kernel's time is measured.
const SIDES: [usize; 4] = [32, 64, 128, 256];
/// Runs of a process, of which the median counts.
const RUNS: usize = 11;

fn main() {
    common::on_one_thread();
    let mut page = format!("# Timings\n\n{}; 45°.\n\n| what | took | target |\n|---|---|---|\n", machine());
    kernels(&mut page);
    meshes(&mut page);
    processes(&mut page);
    print!("{page}");
    fs::write(results("timings.md"), page).unwrap();
}

fn line(page: &mut String, what: &str, took: &str, target: &str) {
    writeln!(page, "| {what} | {took} | {target} |").unwrap();
}

fn kernels(page: &mut String) {
    let of = |n: usize| timed(|| form_factors(&fold(ANGLE_DEG, n))).0;
    line(page, "exact form factors, 10x10", &milliseconds(of(10)), "1 ms");
    let times = SIDES.map(of);
    line(page, "exact form factors, 256x256", &milliseconds(times[3]), "1.5 s");
    let growth: Vec<_> = times
        .windows(2)
        .zip(SIDES.windows(2))
        .map(|(times, sides)| {
            let exponent = (times[1] / times[0]).ln() / (sides[1] as f64 / sides[0] as f64).ln();
            format!("{exponent:.2} from {} to {}", sides[0], sides[1])
        })
        .collect();
    line(page, "their growth with n, exponent (distinct entries: 3)", &growth.join(", "), "");
}

fn meshes(page: &mut String) {
    for exponent in 3..=8 {
        let tolerance = 10_f64.powi(-exponent);
        let (took, (response, accuracy)) =
            timed(|| respond(&fold(ANGLE_DEG, 10), Mesh::Auto, tolerance).unwrap());
        let error = accuracy.facet_mean_error.unwrap_or(f64::NAN);
        let what = format!(
            "--mesh auto, tolerance {tolerance:e}: {} unknowns, {} modes, estimated error {error:.0e}",
            accuracy.unknowns,
            response.poles().len()
        );
        line(page, &what, &milliseconds(took), "");
    }
}

fn processes(page: &mut String) {
    for (flags, target) in [
        ("", "10 ms"),
        ("--mesh facets", "10 ms"),
        ("--tolerance 1e-3", ""),
        ("--facets 256x256 --mesh facets", "10 s, 1.5 GB"),
    ] {
        let runs = if flags.contains("256") { 1 } else { RUNS };
        let mut all: Vec<_> = (0..runs).map(|_| run(flags)).collect();
        all.sort_unstable();
        let (time, peak_kb) = all[runs / 2];
        let took = format!("{}, {} MB", milliseconds(1e3 * time.as_secs_f64()), peak_kb / 1000);
        line(page, &format!("`vkernel -j 1 {flags}`, whole process"), &took, target);
    }
}

/// Time of one run, and the most memory it was seen to hold, kB.
fn run(flags: &str) -> (Duration, u64) {
    let start = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_vkernel"))
        .args(["-j", "1"])
        .args(flags.split_whitespace())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak_kb = 0;
    while child.try_wait().unwrap().is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let peak = text.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
        peak_kb = peak_kb.max(peak.trim().trim_end_matches(" kB").parse().unwrap_or(0));
        std::thread::sleep(Duration::from_micros(100));
    }
    (start.elapsed(), peak_kb)
}

fn milliseconds(time: f64) -> String {
    match time {
        long if long >= 1000.0 => format!("{:.2} s", long / 1000.0),
        short if short < 10.0 => format!("{short:.2} ms"),
        middle => format!("{middle:.0} ms"),
    }
}
