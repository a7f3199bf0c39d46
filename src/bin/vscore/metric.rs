//! The metrics as values of `--metrics`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use vfold::score::{METRICS, Metric};

/// Reads the name of a metric.
pub fn metric() -> impl TypedValueParser<Value = &'static Metric> {
    let names = METRICS.iter().map(|metric| PossibleValue::new(metric.flag).help(metric.help));
    PossibleValuesParser::new(names).try_map(|name| {
        METRICS.iter().find(|metric| metric.flag == name).ok_or_else(|| format!("no metric {name}"))
    })
}
