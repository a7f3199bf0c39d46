//! Times that have a target, and those of whole runs and their parts; one thread unless stated. Markdown goes
//! to standard output and to `benches/results/timings.md`.

#![allow(clippy::unwrap_used, reason = "a measurement stops at the first surprise")]
#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]

#[path = "common/mod.rs"]
mod common;
#[allow(dead_code, reason = "another benchmark uses the rest")]
#[path = "kernel/reference.rs"]
mod reference;
#[allow(dead_code, reason = "another benchmark uses the rest")]
#[path = "common/samples.rs"]
mod samples;
#[allow(dead_code, reason = "another benchmark uses the rest")]
#[path = "common/solutions.rs"]
mod solutions;
#[path = "common/tools.rs"]
mod tools;

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::{fold, machine, results, timed, timed_once};
use image::{ImageBuffer, Rgb};
use samples::Batch;
use tools::shell;
use vfold::estimate::map;
use vfold::estimate::prior::Prior;
use vfold::kernel::mesh::respond;
use vfold::paper::form_factors;

const ANGLE_DEG: f64 = 45.0;
/// Angles at which form factors are known in 60 digits.
const ANGLES_DEG: [f64; 9] = [1.0, 5.0, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0, 179.0];
/// Runs of a process, of which the median counts.
const RUNS: usize = 11;

fn main() {
    common::on_one_thread();
    let mut page =
        format!("# Timings\n\n{}; 45°.\n\n| what | measured | target |\n|---|---|---|\n", machine());
    let work = tempfile::tempdir().unwrap();
    kernels(&mut page);
    estimates(&mut page, work.path());
    pipelines(&mut page);
    batches(&mut page, work.path());
    photograph(&mut page, work.path());
    real_sheet(&mut page, work.path());
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
    let error = |angle_deg: f64| {
        let fold = fold(angle_deg, 10);
        reference::entry_error(&fold, &form_factors(&fold))
    };
    let error = ANGLES_DEG.map(error).into_iter().fold(0.0, f64::max);
    line(page, "their largest error, 1° to 179°", &format!("{error:.0e}"), "1e-12");
    line(page, "exact form factors, 256x256", &milliseconds(of(256)), "1.2 s");
}

/// Estimates in process, processor time.
fn estimates(page: &mut String, work: &Path) {
    for (noise, target) in [("1e-3", "1 ms"), ("0", "2 ms")] {
        let path = work.join("chart.ndjson");
        photographed(&format!("--reflectance cc24 --noise-sd {noise}"), &path);
        let batch = Batch::read(path.to_str().unwrap()).unwrap();
        let prior = Prior::built_in(batch.grid.wavelengths_nm()).unwrap();
        let estimate = |shot: &samples::Shot| {
            timed_once(|| map::estimate(&shot.data(&batch.scene).unwrap(), &prior, None).unwrap()).0
        };
        let took = milliseconds(median(batch.shots.iter().map(estimate).collect()));
        line(page, &format!("an estimate, 10x10, facet noise {noise}, median of 24"), &took, target);
    }
}

/// Sheets in front of the default camera.
fn photographed(flags: &str, path: &Path) {
    let made = shell(&format!("vkernel | vforward {flags} >\"$path\"")).env("path", path).status();
    assert!(made.unwrap().success());
}

fn pipelines(page: &mut String) {
    for (sheets, target) in [("cc24:orange", "30 ms"), ("cc24", "")] {
        let script =
            format!("vkernel | vforward --reflectance {sheets} | vestimate | vscore --table >/dev/null");
        let run = || {
            let start = Instant::now();
            assert!(shell(&script).status().unwrap().success());
            1e3 * start.elapsed().as_secs_f64()
        };
        let took = milliseconds(median((0..RUNS).map(|_| run()).collect()));
        line(page, &format!("four tools, {sheets}, wall"), &took, target);
    }
}

/// Samples a second, and whether more of them take more memory.
fn batches(page: &mut String, work: &Path) {
    let [few, many] = ["few.ndjson", "many.ndjson"].map(|name| work.join(name));
    photographed("--reflectance munsell --noise-sd 1e-3", &few);
    let text = fs::read_to_string(&few).unwrap();
    let samples: String = text.split_inclusive('\n').skip(1).collect();
    let count = samples.lines().count();
    fs::write(&many, format!("{text}{}", samples.repeat(3))).unwrap();
    let [once, often] = [&few, &many].map(|path| run("vestimate", &["-j", "2", path.to_str().unwrap()]));
    let rate = 4.0 * count as f64 / often.0.as_secs_f64();
    let took =
        format!("{rate:.0} samples/s; {} MB, for a quarter of them {} MB", often.1 / 1000, once.1 / 1000);
    line(page, &format!("vestimate -j 2, {} samples", 4 * count), &took, "1500 samples/s, memory flat");
}

/// A photograph of 24 million pixels, measured and merely decoded.
fn photograph(page: &mut String, work: &Path) {
    let path = work.join("photo.tif");
    let pixel = |x: u32, y: u32| Rgb([1000 + 7 * x as u16, 2000 + 5 * y as u16, 3000 + (x + y) as u16]);
    ImageBuffer::<Rgb<u16>, Vec<u16>>::from_fn(6000, 4000, pixel).save(&path).unwrap();
    let scene = work.join("scene.json");
    let made = shell("vkernel --angle-deg 50 -o \"$scene\"").env("scene", &scene).status();
    assert!(made.unwrap().success());
    let scene = scene.to_str().unwrap();
    let crease = "3319,3680 3218,834";
    let panels = [format!("{crease} 1629,458 1719,3557"), format!("{crease} 4247,320 4371,3445")];
    let flags = [path.to_str().unwrap(), "--scene", scene, "--camera", "nikon-d5100"];
    let corners = ["--panel0", &panels[0], "--panel1", &panels[1]];
    // In turn: how fast the machine is changes from second to second.
    let [mut decoding, mut on_one, mut on_two] = [(); 3].map(|()| Vec::new());
    let mut peak = 0;
    for _ in 0..5 {
        let start = Instant::now();
        drop(image::open(&path).unwrap());
        decoding.push(start.elapsed().as_secs_f64());
        for (threads, took) in [("1", &mut on_one), ("2", &mut on_two)] {
            let (time, peak_kb) = run("vextract", &[&["-j", threads], &flags[..], &corners].concat());
            took.push(time.as_secs_f64());
            peak = peak.max(peak_kb);
        }
    }
    let [decoding, on_one, on_two] = [decoding, on_one, on_two].map(median);
    let said = format!(
        "{:.2} x decoding ({}) on one thread, {:.2} on two, {} MB",
        on_one / decoding,
        milliseconds(1e3 * decoding),
        on_two / decoding,
        peak / 1000
    );
    line(page, "vextract, 24 million pixels, 16-bit TIFF of 144 MB, medians of 5", &said, "1.4, 1.2, 216 MB");
}

/// A photograph that an ideal fold does not explain, as another camera took it than the one stated:
/// everything is fitted.
fn real_sheet(page: &mut String, work: &Path) {
    const PHOTOGRAPHS: usize = 20;
    let path = work.join("sheets.ndjson");
    let script = "vkernel --angle-deg 50 | vextract -q tests/data/photos/a_ideal_magenta_50.exr \
        --camera sigma-sd-merrill --illuminant D65 --panel0 '332,462 345,77 122,12 104,442' \
        --panel1 '332,462 345,77 485,17 472,446' >\"$path\"";
    assert!(shell(script).env("path", &path).status().unwrap().success());
    let text = fs::read_to_string(&path).unwrap();
    let (scene, sample) = text.split_once('\n').unwrap();
    fs::write(&path, format!("{scene}\n{}", sample.repeat(PHOTOGRAPHS))).unwrap();
    let one = || 1e3 * run("vestimate", &["-j", "1", path.to_str().unwrap()]).0.as_secs_f64();
    let took = median((0..5).map(|_| one()).collect()) / PHOTOGRAPHS as f64;
    line(
        page,
        "vestimate -j 1, a photograph with everything unknown and another camera stated, mean of 20",
        &milliseconds(took),
        "60 ms",
    );
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn meshes(page: &mut String) {
    for exponent in 3..=8 {
        let tolerance = 10_f64.powi(-exponent);
        let (took, (response, accuracy)) = timed(|| respond(&fold(ANGLE_DEG, 10), tolerance).unwrap());
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
        ("", ""),
        ("--mesh facets", ""),
        ("--tolerance 1e-3", ""),
        ("--facets 256x256 --mesh facets", "1 GB"),
    ] {
        let runs = if flags.contains("256") { 1 } else { RUNS };
        let flags: Vec<&str> = ["-j", "1"].into_iter().chain(flags.split_whitespace()).collect();
        let mut all: Vec<_> = (0..runs).map(|_| run("vkernel", &flags)).collect();
        all.sort_unstable();
        let (time, peak_kb) = all[runs / 2];
        let took = format!("{}, {} MB", milliseconds(1e3 * time.as_secs_f64()), peak_kb / 1000);
        line(page, &format!("`vkernel {}`, whole process, wall", flags.join(" ")), &took, target);
    }
}

/// Time of one run, and the most memory it was seen to hold, kB.
fn run(tool: &str, flags: &[&str]) -> (Duration, u64) {
    let start = Instant::now();
    let mut child = Command::new(Path::new(env!("CARGO_BIN_EXE_vkernel")).with_file_name(tool))
        .args(flags)
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
