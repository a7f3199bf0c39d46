//! The fuzz targets, compiled once for all of them.
//!
//! ```sh
//! cargo install cargo-fuzz
//! mkdir -p fuzz/corpus/csv
//! cargo +nightly fuzz run csv fuzz/corpus/csv tests/corpus/kept/csv -- \
//!     -dict=fuzz/tokens.dict -max_total_time=600 -timeout=20 -rss_limit_mb=4096
//! ```
//! `raw` takes `--features raw`; `surface` and `clusters` take milliseconds to seconds an input and want
//! `-max_len=160`. What breaks something goes to `tests/corpus/kept`, where the tests find it.

#[path = "../tests/corpus/targets/mod.rs"]
pub mod targets;
