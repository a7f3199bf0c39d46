//! Pages of benches/results say what the tools print: some cells of each, as nearly as a page may be behind.
//! `benches/all` makes the pages.

use std::fs;

use crate::common::Workdir;

/// How far what the tools print may be from a page, relative to it: pages are measured once after several
/// changes of prior or estimator, of which each moves figures by a few per cent.
const BEHIND: f64 = 0.1;

/// A cell of a page: the heading above its table, how its row begins, its column from 0, and the samples and
/// estimates whose mean RMSE it has, and whose mean CIEDE2000, if the page says it.
struct Cell {
    page: &'static str,
    heading: &'static str,
    row: &'static str,
    column: usize,
    samples: &'static str,
    estimate: &'static str,
}

const ESTIMATES: &str = "benches/results/estimates.md";
const STRESS: &str = "benches/results/stress.md";
const PRIORS: &str = "benches/results/priors.md";
const NOISY: &str = "vkernel | vforward --reflectance cc24 --noise-sd 1e-3";

const CELLS: [Cell; 10] = [
    Cell {
        page: "benches/results/accuracy.md",
        heading: "# Accuracy",
        row: "| ideal, simulated |",
        column: 2,
        samples: "for seed in $(seq 20); do
            vkernel | vforward --reflectance cc24 --camera sigma-sd-merrill --noise-sd 1e-3 --seed $seed
        done",
        estimate: "vestimate",
    },
    Cell {
        page: ESTIMATES,
        heading: "# Estimates",
        row: "| cc24 | canon-5d-mark-ii | 1e-3 |",
        column: 3,
        samples: "vkernel | vforward --reflectance cc24 --camera canon-5d-mark-ii --noise-sd 1e-3",
        estimate: "vestimate",
    },
    Cell {
        page: STRESS,
        heading: "## Noise",
        row: "| 1e-3 |",
        column: 1,
        samples: NOISY,
        estimate: "vestimate",
    },
    Cell {
        page: STRESS,
        heading: "## Noise",
        row: "| 1e-1 |",
        column: 1,
        samples: "vkernel | vforward --reflectance cc24 --noise-sd 1e-1",
        estimate: "vestimate",
    },
    Cell {
        page: STRESS,
        heading: "## Angle",
        row: "| 90 |",
        column: 1,
        samples: "vkernel --angle-deg 90 | vforward --reflectance cc24 --noise-sd 1e-3",
        estimate: "vestimate",
    },
    Cell {
        page: STRESS,
        heading: "## Angle",
        row: "| 45 |",
        column: 2,
        samples: NOISY,
        estimate: "vestimate --prior smooth --smoothness 1e-3",
    },
    Cell {
        page: STRESS,
        heading: "## Exposure",
        row: "| 0.3 |",
        column: 2,
        samples: "vkernel | vforward --reflectance cc24 --noise-sd 1e-3 --exposure 0.3",
        estimate: "vestimate --fit exposure",
    },
    Cell {
        page: STRESS,
        heading: "## Sun off",
        row: "| 5 |",
        column: 1,
        samples: "vkernel --tilt-deg 5 | vforward --reflectance cc24 --noise-sd 1e-3",
        estimate: "vestimate",
    },
    Cell {
        page: PRIORS,
        heading: "# Priors",
        row: "| cc24 | 1e-3 |",
        column: 3,
        samples: NOISY,
        estimate: "vestimate",
    },
    Cell {
        page: PRIORS,
        heading: "# Priors",
        row: "| cc24 | 1e-2 |",
        column: 3,
        samples: "vkernel | vforward --reflectance cc24 --noise-sd 1e-2",
        estimate: "vestimate",
    },
];

#[test]
fn cells_are_what_the_tools_print() {
    let folder = Workdir::new();
    let wrong: Vec<_> = CELLS.iter().filter_map(|cell| fault(&folder, cell)).collect();
    assert!(wrong.is_empty(), "{}\nbenches/all makes the tables anew", wrong.join("\n"));
}

/// What a cell says beside what the tools print, if these differ.
fn fault(folder: &Workdir, cell: &Cell) -> Option<String> {
    let page = fs::read_to_string(format!("{}/{}", env!("CARGO_MANIFEST_DIR"), cell.page)).unwrap();
    let below = &page[page.find(cell.heading).unwrap()..];
    let row = below.lines().find(|line| line.starts_with(cell.row));
    let cells: Vec<_> = row.unwrap_or_default().trim_matches(['|', ' ']).split('|').collect();
    let stated = cells.get(cell.column..).map(|cells| cells.join("/")).unwrap_or_default();
    let run = folder.sh(&format!("{} | {} -q | vscore --table", cell.samples, cell.estimate));
    let printed: Vec<_> = run.stdout.lines().filter(|line| line.starts_with("mean ")).collect();
    let printed: Vec<_> = printed.concat().split_whitespace().skip(1).take(2).map(str::to_owned).collect();
    let stated: Vec<_> = stated.split(['/', ',']).map(str::trim).take(2).map(str::to_owned).collect();
    let agree = printed.len() == 2
        && !stated.is_empty()
        && stated.iter().zip(&printed).all(|(stated, printed)| is_near(stated, printed));
    let what = format!("{}, {} {}, column {}", cell.page, cell.heading, cell.row, cell.column);
    (!agree).then(|| format!("{what}: says {stated:?}, the tools print {printed:?} {}", run.stderr))
}

/// Whether a number is near that of a page, or the same to the digits that the page has.
fn is_near(stated: &str, printed: &str) -> bool {
    let digits = stated.split_once('.').map_or(0, |(_, digits)| digits.len()) as i32;
    let (Ok(a), Ok(b)) = (stated.parse::<f64>(), printed.parse::<f64>()) else { return false };
    (a - b).abs() < (BEHIND * a).max(0.51 * 10.0_f64.powi(-digits))
}
