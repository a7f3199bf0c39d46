//! Kept inputs with chance's edits: what fuzzing does, on a stable toolchain and without its guidance.
//!
//! `PROPTEST_CASES=1000000 cargo test --test corpus mutations` looks for more.

use std::fs;

use proptest::prelude::*;
use proptest::sample::Index;

use crate::targets::TARGETS;
use crate::{cases, kept};

/// What breaks readers.
const TOKENS: &[&[u8]] = &[
    b"NaN",
    b"1e308",
    b"-1",
    b"0",
    b"-",
    b"99999999999999999999",
    b"1e999",
    b"\0",
    b"\xff\xff\xff\xff",
    b"\0\0\0\0",
    b"[",
    b"]",
    b"{",
    b"\"",
    b",",
    b"\n",
    b" ",
    b"\x1b",
    b"\xef\xbb\xbf",
    b"<",
    b"&",
    b"\x80\0\0\0",
];

#[derive(Clone, Debug)]
enum Edit {
    Byte(Index, u8),
    Insert(Index, Index),
    Remove(Index, u8),
    Repeat(Index, u8),
    Cut(Index),
}

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        4 => (any::<Index>(), any::<u8>()).prop_map(|(at, byte)| Edit::Byte(at, byte)),
        4 => (any::<Index>(), any::<Index>()).prop_map(|(at, token)| Edit::Insert(at, token)),
        2 => (any::<Index>(), any::<u8>()).prop_map(|(at, length)| Edit::Remove(at, length)),
        2 => (any::<Index>(), any::<u8>()).prop_map(|(at, length)| Edit::Repeat(at, length)),
        1 => any::<Index>().prop_map(Edit::Cut),
    ]
}

fn apply(bytes: &mut Vec<u8>, edit: &Edit) {
    use Edit::{Byte, Cut, Insert, Remove, Repeat};
    let (Byte(at, _) | Insert(at, _) | Remove(at, _) | Repeat(at, _) | Cut(at)) = edit;
    let at = at.index(bytes.len() + 1);
    let up_to = |length: u8| (at + usize::from(length)).min(bytes.len());
    match *edit {
        Byte(_, byte) if at < bytes.len() => bytes[at] = byte,
        Byte(_, byte) => bytes.push(byte),
        Insert(_, token) => drop(bytes.splice(at..at, token.get(TOKENS).iter().copied())),
        Remove(_, length) => drop(bytes.drain(at..up_to(length))),
        Repeat(_, length) => {
            let part = bytes[at..up_to(length)].to_vec();
            bytes.splice(at..at, part);
        }
        Cut(_) => bytes.truncate(at),
    }
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn edited_inputs_are_taken_or_refused_plainly(
        target in 0..TARGETS.len(),
        file in any::<Index>(),
        edits in prop::collection::vec(edit(), 1..6),
    ) {
        let (name, target) = TARGETS[target];
        let mut bytes = fs::read(file.get(&kept(name))).unwrap();
        edits.iter().for_each(|edit| apply(&mut bytes, edit));
        target(&bytes);
    }
}
