//! Scores as a table for people.

use vfold::Result;
use vfold::cli::one_line;
use vfold::message::is_formula;
use vfold::score::{Group, Metric, Statistics, Summary};
use vfold::stream::{Output, Sample};

/// Columns of a terminal; a table is wider only with too many scores.
const WIDTH: usize = 80;
/// Most and least columns for a sample's name.
const NAME: [usize; 2] = [28, 12];

/// A name that remains text wherever the table is pasted.
fn cell(name: &str) -> String {
    let name = one_line(name);
    if is_formula(&name) { format!("'{name}") } else { name }
}

/// One column per score.
pub struct Table {
    name_width: usize,
    columns: Vec<Column>,
}

struct Column {
    name: String,
    width: usize,
    decimals: usize,
}

impl Table {
    /// A column for each of these scores of some metrics.
    pub fn new(scores: &[(&'static Metric, String)]) -> Self {
        let column = |(metric, name): &(&Metric, String)| {
            let width = metric.width.max(name.chars().count() + 1);
            Column { width, decimals: metric.decimals, name: name.clone() }
        };
        let columns: Vec<Column> = scores.iter().map(column).collect();
        let taken: usize = columns.iter().map(|column| column.width + 1).sum();
        Self { name_width: WIDTH.saturating_sub(taken).clamp(NAME[1], NAME[0]), columns }
    }

    pub fn header(&self, out: &mut Output) -> Result<()> {
        let heading = |column: &Column| {
            let (metric, light) = column.name.split_once('_').unwrap_or((&column.name, ""));
            let heading = format!("{} {light}", metric.to_uppercase());
            format!(" {:>1$}", one_line(heading.trim_end()), column.width)
        };
        out.text(&self.named("sample", &self.columns.iter().map(heading).collect::<String>()))
    }

    pub fn row(&self, out: &mut Output, sample: &Sample) -> Result<()> {
        let id = cell(&sample.id());
        if let Some(error) = sample.error()? {
            return out.row(sample, &self.named(&id, &format!(" {}", one_line(&error))));
        }
        let scores = sample.scores()?.unwrap_or_default();
        let value = |name: &str| scores.iter().find(|score| score.name == name).map(|score| score.value);
        out.row(sample, &self.line(&id, value))
    }

    /// Mean, median and worst of each group and of all.
    pub fn footer(&self, out: &mut Output, all: &Summary, by: Option<(&str, &[Group])>) -> Result<()> {
        if let Some((field, groups)) = by {
            for Group { value, summary } in groups {
                let value = cell(value);
                out.text(&format!("{field} {value}: {} of {} scored", summary.scored(), summary.samples()))?;
                self.statistics(out, summary)?;
            }
            out.text("all")?;
        }
        self.statistics(out, all)
    }

    fn statistics(&self, out: &mut Output, summary: &Summary) -> Result<()> {
        let statistics = summary.statistics();
        if statistics.is_empty() {
            return out.text("no sample was scored");
        }
        let line = |name: &str, pick: fn(&Statistics) -> f64| {
            self.line(name, |score| statistics.iter().find(|one| one.name == score).map(pick))
        };
        out.text(&line("mean", |one| one.mean))?;
        out.text(&line("median", |one| one.median))?;
        out.text(&line("worst", |one| one.worst))
    }

    fn line(&self, name: &str, value: impl Fn(&str) -> Option<f64>) -> String {
        let cell = |column: &Column| match value(&column.name) {
            Some(value) => format!(" {value:>0$.1$}", column.width, column.decimals),
            None => format!(" {:>1$}", "-", column.width),
        };
        self.named(name, &self.columns.iter().map(cell).collect::<String>())
    }

    /// A name in front of the rest of its line; one that is too long gets its own line.
    fn named(&self, name: &str, rest: &str) -> String {
        let width = self.name_width;
        if name.chars().count() > width {
            return format!("{name}\n{:width$}{rest}", "");
        }
        format!("{name:<width$}{rest}")
    }
}
