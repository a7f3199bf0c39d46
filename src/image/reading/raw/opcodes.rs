//! DNG's lists of what is still to be done to a sensor's numbers. Nothing of it is done here.
//!
//! # Source
//! Adobe, *Digital Negative Specification* 1.7, chapter 7.

use rawler::decoders::{Decoder, WellKnownIFD};
use rawler::formats::tiff::Value;
use rawler::tags::DngTag;

const LISTS: [DngTag; 3] = [DngTag::OpcodeList1, DngTag::OpcodeList2, DngTag::OpcodeList3];

/// Those without which numbers are not in proportion to light. Others mend single pixels, or shading and distortion of the lens, which
/// pictures without lists have as well.
const NEEDED: [(u32, &str); 6] = [
    (7, "MapTable"),
    (8, "MapPolynomial"),
    (10, "DeltaPerRow"),
    (11, "DeltaPerColumn"),
    (12, "ScalePerRow"),
    (13, "ScalePerColumn"),
];

/// The first opcode of a file without which its numbers are no light.
pub(super) fn needed(decoder: &dyn Decoder) -> Option<&'static str> {
    let directory = decoder.ifd(WellKnownIFD::Raw).ok().flatten()?;
    LISTS.into_iter().find_map(|list| match &directory.get_entry(list)?.value {
        Value::Undefined(list) | Value::Byte(list) => needed_in(list),
        _ => None,
    })
}

/// The same of one list: a count, and for each opcode number, version, flags, length and parameters, big end first.
fn needed_in(list: &[u8]) -> Option<&'static str> {
    let number = |at: usize| Some(u32::from_be_bytes(*list.get(at..)?.first_chunk()?));
    let mut at = 4;
    for _ in 0..number(0)? {
        let opcode = number(at)?;
        if let Some((_, name)) = NEEDED.iter().find(|(needed, _)| *needed == opcode) {
            return Some(name);
        }
        at = at.checked_add(16)?.checked_add(number(at + 12)? as usize)?;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(opcodes: &[(u32, usize)]) -> Vec<u8> {
        let mut bytes = (opcodes.len() as u32).to_be_bytes().to_vec();
        for (opcode, length) in opcodes {
            bytes.extend([*opcode, 0x0103_0000, 0, *length as u32].into_iter().flat_map(u32::to_be_bytes));
            bytes.resize(bytes.len() + length, 0);
        }
        bytes
    }

    #[test]
    fn an_opcode_is_found_behind_others() {
        assert_eq!(needed_in(&list(&[(9, 84), (1, 12)])), None);
        assert_eq!(needed_in(&list(&[(9, 84), (8, 44)])), Some("MapPolynomial"));
        assert_eq!(needed_in(&list(&[(3, 7), (12, 4)])), Some("ScalePerRow"));
    }

    #[test]
    fn lists_cut_short_have_none() {
        assert_eq!(needed_in(&[]), None);
        assert_eq!(needed_in(&list(&[(9, 84), (8, 44)])[..100]), None);
        assert_eq!(needed_in(&u32::MAX.to_be_bytes().repeat(9)), None);
    }
}
