//! Records in which values are replaced: JSON all the same, but not what the tools wrote.

use serde_json::{Value, json};

use super::stream::stream;

/// Streams of the tools: a fold, a kernel made elsewhere, a shape under two lights.
const STREAMS: [&str; 3] = [
    include_str!("../streams/fold.ndjson"),
    include_str!("../streams/kernel.ndjson"),
    include_str!("../streams/shape.ndjson"),
];

pub fn records(bytes: &[u8]) {
    stream(edited_stream(bytes).as_bytes());
}

/// A stream that the first byte chooses, [edited].
pub fn edited_stream(bytes: &[u8]) -> String {
    let (which, edits) = bytes.split_first().unwrap_or((&0, &[]));
    edited(STREAMS[usize::from(*which) % STREAMS.len()], edits)
}

/// A stream with edits of four bytes: which record, which of its values, what comes in its place.
pub fn edited(stream: &str, edits: &[u8]) -> String {
    let mut records: Vec<Value> = stream.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    for edit in edits.chunks_exact(4) {
        let record = usize::from(edit[0]) % records.len();
        let count = count(&records[record]);
        let mut place = usize::from(u16::from_le_bytes([edit[1], edit[2]])) % count;
        replace(&mut records[record], &mut place, edit[3]);
    }
    records.iter().map(|record| format!("{record}\n")).collect()
}

/// A value and all that are in it.
fn count(value: &Value) -> usize {
    1 + match value {
        Value::Array(items) => items.iter().map(count).sum::<usize>(),
        Value::Object(fields) => fields.values().map(count).sum(),
        _ => 0,
    }
}

/// Replaces the value that comes `place`th.
fn replace(value: &mut Value, place: &mut usize, edit: u8) {
    if *place == 0 {
        put(value, edit);
    }
    let Some(rest) = place.checked_sub(1) else {
        *place = usize::MAX;
        return;
    };
    *place = rest;
    let inside: Box<dyn Iterator<Item = &mut Value>> = match value {
        Value::Array(items) => Box::new(items.iter_mut()),
        Value::Object(fields) => Box::new(fields.values_mut()),
        _ => return,
    };
    for inner in inside {
        if *place == usize::MAX {
            return;
        }
        replace(inner, place, edit);
    }
}

fn put(value: &mut Value, edit: u8) {
    let number = value.as_f64().unwrap_or(1.0);
    *value = match edit % 24 {
        0 => Value::Null,
        1 => json!(0),
        2 => json!(-number),
        3 => json!(1e308),
        4 => json!(1e30),
        5 => json!(5e-324),
        6 => json!(u64::MAX),
        7 => json!(i64::MIN),
        8 => json!(""),
        9 => json!("\n\u{1b}[31m"),
        10 => json!([]),
        11 => json!({}),
        12 => json!(true),
        13 => json!([[[[[[]]]]]]),
        14 => json!(number * (1.0 + 1e-9)),
        15 => json!(number * 2.0),
        16 => json!(1.0 - 1e-12),
        17 => json!(1),
        18 => json!(number + 1.0),
        19 => json!(1e9),
        // a list with one more, one fewer, or in another order
        20..=23 => {
            let Value::Array(items) = value else { return };
            match edit % 24 {
                20 => items.extend(items.last().cloned()),
                21 => drop(items.pop()),
                22 => items.reverse(),
                _ => items.push(Value::Null),
            }
            return;
        }
        _ => return,
    };
}
