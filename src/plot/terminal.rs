//! Estimated spectra for the terminal: braille dots, or plain ASCII where the locale has only that.

mod canvas;

use std::env;
use std::io::{self, Write};

use console::{Style, Term};

use super::spectra::Curve;
use crate::message::printable;
use canvas::{Canvas, Cell, ROWS};

/// Rows per label of the reflectance.
const LABEL_ROWS: usize = 3;
/// Columns of the reflectance labels.
const MARGIN: usize = 7;
/// Least and most columns of a plot, and those of anything but a terminal.
const COLUMNS: [usize; 2] = [40, 160];
const COLUMNS_OF_NO_TERMINAL: usize = 80;
/// Columns for a wavelength label and the space around it.
const LABEL_COLUMNS: f64 = 8.0;
/// Possible steps of the wavelength labels, nm.
const LABEL_STEPS_NM: [f64; 6] = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0];

/// Draws the first curves of `all` on standard error, one below the other, as wide as the terminal.
///
/// A closed standard error is ignored.
pub fn draw<'a>(curves: impl ExactSizeIterator<Item = &'a Curve>, all: usize) {
    let terminal = Term::stderr();
    let columns = terminal.size_checked().map_or(COLUMNS_OF_NO_TERMINAL, |(_, columns)| columns.into());
    let look =
        Look { glyphs: if is_utf8() { &BRAILLE } else { &ASCII }, colours: console::colors_enabled_stderr() };
    let shown = curves.len();
    for curve in curves {
        let _ = io::stderr().write_all(text(curve, columns, &look).as_bytes());
    }
    if shown < all {
        let _ = writeln!(io::stderr(), "{shown} of {all} samples");
    }
}

/// Whether the locale is UTF-8: the first of its variables that is set counts.
fn is_utf8() -> bool {
    let set = ["LC_ALL", "LC_CTYPE", "LANG"]
        .iter()
        .find_map(|name| env::var(name).ok().filter(|value| !value.is_empty()));
    set.is_some_and(|locale| locale.to_ascii_lowercase().replace('-', "").ends_with("utf8"))
}

/// The glyphs and colours of a plot.
struct Look {
    glyphs: &'static Glyphs,
    colours: bool,
}

/// The characters of a plot.
struct Glyphs {
    /// Dots of a character, across and down.
    dots: [usize; 2],
    /// The character with these dots.
    curve: fn(u8) -> char,
    band: char,
    truth: char,
    /// Vertical, horizontal, corner, and label ticks on each.
    axes: [char; 5],
    /// The curve as shown in the legend.
    sample: &'static str,
}

static BRAILLE: Glyphs = Glyphs {
    dots: [2, 4],
    curve: |dots| char::from_u32(0x2800 + u32::from(dots)).unwrap_or('*'),
    band: '░',
    truth: '×',
    axes: ['│', '─', '└', '┤', '┬'],
    sample: "⠒⠒",
};
static ASCII: Glyphs = Glyphs {
    dots: [1, 1],
    curve: |_| '*',
    band: ':',
    truth: 'x',
    axes: ['|', '-', '+', '+', '+'],
    sample: "**",
};
/// The complete plot of a curve: its name and a legend, rows of characters, wavelengths.
fn text(curve: &Curve, columns: usize, look: &Look) -> String {
    let width = columns.clamp(COLUMNS[0], COLUMNS[1]) - MARGIN - 1;
    let canvas = Canvas::of(curve, width, look.glyphs.dots);
    let mut text = look.title(curve);
    for (n, row) in canvas.rows.iter().enumerate() {
        let level = canvas.top * (1.0 - n as f64 / ROWS as f64);
        text += &if n % LABEL_ROWS == 0 {
            look.tick(level)
        } else {
            format!("{:>1$}", look.glyphs.axes[0], MARGIN)
        };
        text += row.iter().map(|cell| look.cell(*cell)).collect::<String>().trim_end();
        text.push('\n');
    }
    text + &look.wavelength_axis(canvas.ends_nm, width)
}

impl Look {
    fn title(&self, curve: &Curve) -> String {
        let Glyphs { band, truth, sample, .. } = self.glyphs;
        let mut title = format!("{}   {} estimate", printable(&curve.name), self.blue().apply_to(sample));
        if curve.reflectance_sd.is_some() {
            title += &format!("  {} two standard deviations", self.dim().apply_to(format!("{band}{band}")));
        }
        if curve.truth.is_some() {
            title += &format!("  {truth}{truth} true");
        }
        title + "\n"
    }

    fn tick(&self, level: f64) -> String {
        format!("{level:>5.2} {}", self.glyphs.axes[3])
    }

    /// The axis, and its labels.
    fn wavelength_axis(&self, ends_nm: [f64; 2], width: usize) -> String {
        let [_, level, corner, _, tick] = self.glyphs.axes;
        let [first, last] = ends_nm;
        let mut line = vec![level; width];
        let mut numbers: Vec<char> = format!("{:<1$}", "  nm", MARGIN + width + 1).chars().collect();
        for nm in labels_nm(ends_nm, width) {
            let column = (((nm - first) / (last - first) * width as f64) as usize).min(width - 1);
            line[column] = tick;
            let number = format!("{nm:.0}");
            let start = (MARGIN + column)
                .saturating_sub(number.len() / 2)
                .min(numbers.len().saturating_sub(number.len()));
            numbers.iter_mut().skip(start).zip(number.chars()).for_each(|(place, digit)| *place = digit);
        }
        let (line, numbers): (String, String) = (line.into_iter().collect(), numbers.into_iter().collect());
        format!("{:>5} {corner}{line}\n{}\n", "0.00", numbers.trim_end())
    }

    fn cell(&self, cell: Cell) -> String {
        match cell {
            Cell { dots: 1.., .. } => self.blue().apply_to((self.glyphs.curve)(cell.dots)).to_string(),
            Cell { truth: true, .. } => self.glyphs.truth.to_string(),
            Cell { band: true, .. } => self.dim().apply_to(self.glyphs.band).to_string(),
            Cell { .. } => " ".to_owned(),
        }
    }

    fn blue(&self) -> Style {
        Style::new().blue().force_styling(self.colours)
    }

    fn dim(&self) -> Style {
        Style::new().dim().force_styling(self.colours)
    }
}

/// Round wavelengths, as many as fit into this many columns.
fn labels_nm([first, last]: [f64; 2], width: usize) -> impl Iterator<Item = f64> {
    let most = width as f64 / LABEL_COLUMNS;
    let step_nm =
        LABEL_STEPS_NM.into_iter().find(|step| (last - first) / step <= most).unwrap_or(last - first);
    let start = (first / step_nm).ceil();
    (0..width).map(move |n| (start + n as f64) * step_nm).take_while(move |nm| *nm <= last)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Look = Look { glyphs: &ASCII, colours: false };

    fn ramp() -> Curve {
        Curve {
            name: "ramp".to_owned(),
            wavelengths_nm: vec![400.0, 700.0],
            reflectance: vec![0.0, 1.0],
            reflectance_sd: None,
            total: None,
            truth: None,
            light: None,
        }
    }

    #[test]
    fn a_ramp_is_a_diagonal() {
        let text = text(&ramp(), 80, &PLAIN);
        let rows: Vec<&str> = text.lines().skip(1).take(ROWS).collect();
        for (n, row) in rows.iter().enumerate() {
            // 72 columns for 12 rows: six each, and where two rows meet
            let stars = row.matches('*').count();
            assert!((6..=7).contains(&stars), "{text}");
            assert_eq!(row.find('*').unwrap() / 6, (MARGIN + 6 * (ROWS - 1 - n)) / 6, "{text}");
        }
    }

    #[test]
    fn nothing_is_wider_than_the_terminal() {
        let banded = Curve {
            reflectance_sd: Some(vec![0.1, 0.1]),
            truth: Some((vec![300.0, 800.0], vec![0.5; 2])),
            ..ramp()
        };
        for columns in [40, 80, 133] {
            for glyphs in [&ASCII, &BRAILLE] {
                let text = text(&banded, columns, &Look { glyphs, colours: false });
                let widest = text.lines().skip(1).map(|line| line.chars().count()).max().unwrap();
                assert!(widest <= columns, "{widest} of {columns}\n{text}");
                assert!(text.contains(glyphs.band) && text.contains(glyphs.truth), "{text}");
            }
        }
    }

    #[test]
    fn lists_that_do_not_fit_are_drawn_as_far_as_they_do() {
        let short = Curve { reflectance: vec![0.5], ..ramp() };
        assert!(!text(&short, 80, &PLAIN).lines().nth(3).unwrap().contains('*'));
        let empty = Curve { wavelengths_nm: Vec::new(), reflectance: Vec::new(), ..ramp() };
        assert_eq!(text(&empty, 80, &PLAIN).lines().count(), ROWS + 3);
    }
}
