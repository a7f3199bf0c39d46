use rawler::imgop::Dim2;

use super::*;

const ACTIVE: Rect = Rect { p: Point { x: 1, y: 2 }, d: Dim2 { w: 8, h: 6 } };

fn list(opcodes: &[(u32, u32, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = (opcodes.len() as u32).to_be_bytes().to_vec();
    for (id, flags, parameters) in opcodes {
        let head = [*id, 0x0103_0000, *flags, parameters.len() as u32];
        bytes.extend(head.into_iter().flat_map(u32::to_be_bytes));
        bytes.extend(parameters);
    }
    bytes
}

fn longs(longs: &[u32]) -> Vec<u8> {
    longs.iter().flat_map(|long| long.to_be_bytes()).collect()
}

fn read(stage: u32, opcodes: &[(u32, u32, Vec<u8>)]) -> Result<Opcodes> {
    read_list(Path::new("a.dng"), Parameters(&list(opcodes)), stage, ACTIVE).map(Opcodes::new)
}

/// The result for uniform light; the picture is the active area without its first row and column.
fn light(stage: u32, opcodes: &[(u32, u32, Vec<u8>)], mosaic: Option<&Mosaic>) -> Array3<f32> {
    let mut light = Array3::from_elem((5, 7, 1), 0.5);
    read(stage, opcodes).unwrap().apply(&mut light, Point::new(2, 3), mosaic);
    light
}

#[test]
fn what_is_not_done_is_named() {
    let refusal = |stage, opcodes: &[(u32, u32, Vec<u8>)]| match read(stage, opcodes) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    };
    for (id, name) in (1..).zip(NAMES).filter(|(id, _)| !is_done(*id, 3)) {
        assert!(refusal(3, &[(5, 0, longs(&[0; 3])), (id, 0, vec![0; 8])]).contains(name), "{name}");
        let passed_over = refusal(3, &[(id, 1, vec![0; 8])]).is_empty();
        assert_eq!(passed_over, !CHANGE_LIGHT.contains(&id), "{name}");
    }
    assert!(refusal(2, &[(99, 0, vec![])]).contains("opcode 99"));
    assert!(refusal(1, &[(9, 1, vec![])]).contains("GainMap in OpcodeList1"));
}

#[test]
fn what_makes_no_sense_is_damaged() {
    let whole = list(&[(9, 0, vec![0; 76])]);
    for bytes in [&whole[..], &whole[..40], &[], &u32::MAX.to_be_bytes().repeat(9)] {
        assert!(read_list(Path::new("a.dng"), Parameters(bytes), 2, ACTIVE).is_err());
    }
    assert!(read(1, &[(5, 0, longs(&[0, 0, 1, 0, 0, 1000, 1000]))]).is_err());
    // no light in the farthest corner, and negative light
    for (coefficient, is_read) in [(-1.0, true), (-1.1, false)] {
        let doubles = [coefficient, 0.0, 0.0, 0.0, 0.0, 0.5, 0.5].into_iter().flat_map(f64::to_be_bytes);
        assert_eq!(read(3, &[(3, 1, doubles.collect())]).is_ok(), is_read, "{coefficient}");
    }
}

#[test]
fn bad_sites_have_no_light() {
    // a point in the picture, one before it and one beyond; a rectangle that extends beyond it
    let sites = longs(&[0, 3, 1, 4, 3, 0, 0, 90, 90, 5, 7, 8, 12]);
    let light = light(1, &[(5, 0, sites)], None);
    let missing = light.indexed_iter().filter(|(_, light)| light.is_nan()).map(|((y, x, _), _)| (y, x));
    assert_eq!(missing.collect::<Vec<_>>(), [(1, 1), (2, 5), (2, 6), (3, 5), (3, 6), (4, 5), (4, 6)]);
    let constant = read(1, &[(4, 1, longs(&[7, 0]))]).unwrap();
    assert!(constant.leaves_out(7.0) && !constant.leaves_out(8.0));
}

#[test]
fn rows_and_columns_have_factors_of_their_own() {
    let factors = |area: &[u32], factors: &[f32]| {
        let floats = factors.iter().flat_map(|factor| factor.to_be_bytes());
        [longs(area), longs(&[factors.len() as u32]), floats.collect()].concat()
    };
    // every other row from the active area's second, all columns but the last
    let rows = factors(&[1, 0, 6, 7, 0, 1, 2, 1], &[2.0, 3.0, 4.0]);
    let columns = factors(&[0, 1, 6, 3, 0, 1, 1, 1], &[10.0, 100.0]);
    let light = light(2, &[(12, 0, rows), (13, 1, columns)], None);
    let row = |row: usize| [0, 1, 2, 3].map(|column| light[[row, column, 0]]);
    assert_eq!([row(0), row(1)], [[10.0, 100.0, 1.0, 1.0], [5.0, 50.0, 0.5, 0.5]]);
    assert_eq!((light[[2, 6, 0]], light[[2, 5, 0]], light[[4, 5, 0]]), (0.5, 1.5, 2.0));
}

/// The axis in the middle, light twice as bright in the farthest corner, by the squared distance.
#[test]
fn vignetting_grows_from_the_axis() {
    let doubles = [1.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.5].into_iter().flat_map(f64::to_be_bytes);
    let light = light(3, &[(3, 1, doubles.collect())], None);
    // half a pixel from the axis in both directions, and 3.5 and 2.5 px; the corner is 5 px away
    for (site, factor) in [([1, 2, 0], 1.02), ([4, 6, 0], 1.74)] {
        assert!((light[site] - 0.5 * factor).abs() < 1e-6, "{site:?}: {}", light[site]);
    }
}

/// After demosaicing a site's plane is its colour.
#[test]
fn planes_are_colours_after_demosaicing() {
    let one_gain = |plane: u32| {
        let map = [
            longs(&[0, 0, 6, 8, plane, 1, 1, 1, 1, 1]),
            vec![0; 32],
            longs(&[1]),
            3_f32.to_be_bytes().to_vec(),
        ];
        vec![(9, 0, map.concat())]
    };
    let mosaic = Mosaic::new("RGGB").unwrap();
    let corner = |light: &Array3<f32>| (light[[0, 0, 0]], light[[0, 1, 0]], light[[1, 1, 0]]);
    assert_eq!(corner(&light(3, &one_gain(1), Some(&mosaic))), (0.5, 1.5, 0.5));
    assert_eq!(corner(&light(2, &one_gain(0), Some(&mosaic))), (1.5, 1.5, 1.5));
    assert_eq!(corner(&light(2, &one_gain(1), Some(&mosaic))), (0.5, 0.5, 0.5));
}
