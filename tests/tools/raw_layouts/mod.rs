//! RAW files laid out as cameras, phones and converters lay them out, made here: what is measured is what was
//! written.
//!
//! Files of real cameras beside `LibRaw`: `raw_files`.

mod lossless_jpeg;
mod tiff;

use std::path::{Path, PathBuf};

use serde_json::Value as Json;
use tempfile::TempDir;
use vfold::image::{Grid, Homography, Photograph, Point, ReadOptions, measure};

use self::tiff::Value::{Ascii, Byte, Directories, Long, Rational, Short, SignedRational, Undefined};
use self::tiff::{Directory, pieces, tiff};
use crate::common::Workdir;

const WIDTH: usize = 80;
const HEIGHT: usize = 60;
/// Light of the picture's left half, and of its right half.
const LIGHT: [[f64; 3]; 2] = [[0.2, 0.4, 0.1], [0.3, 0.15, 0.25]];
const PANELS: [[[f64; 2]; 4]; 2] = [
    [[40.0, 55.0], [40.0, 5.0], [5.0, 10.0], [5.0, 50.0]],
    [[40.0, 55.0], [40.0, 5.0], [75.0, 10.0], [75.0, 50.0]],
];

const STRIPS: [u16; 2] = [273, 279];
const TILES: [u16; 2] = [324, 325];
const SUB_DIRECTORIES: u16 = 330;
/// By how many rows and columns are interleaved.
const INTERLEAVE: [u16; 2] = [50975, 52547];

fn light(x: usize, colour: usize) -> f64 {
    LIGHT[usize::from(x >= WIDTH / 2)][colour]
}

/// The colour of a site of a mosaic that begins with red, then green.
fn bayer(x: usize, y: usize) -> usize {
    x % 2 + y % 2
}

/// Numbers of a sensor's sites, by column, row and light.
fn sites(width: usize, height: usize, number: impl Fn(usize, usize, f64) -> f64) -> Vec<u16> {
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    places.map(|(x, y)| number(x, y, light(x, bayer(x, y))).round() as u16).collect()
}

/// Numbers as they are in an uncompressed file.
fn packed(numbers: &[u16], bits: usize, is_big: bool) -> Vec<u8> {
    if bits == 16 {
        let bytes = |number: &u16| if is_big { number.to_be_bytes() } else { number.to_le_bytes() };
        return numbers.iter().flat_map(bytes).collect();
    }
    let mut waiting = (0_u64, 0);
    let mut bytes = Vec::new();
    for number in numbers {
        waiting = (waiting.0 << bits | u64::from(*number), waiting.1 + bits);
        while waiting.1 >= 8 {
            waiting.1 -= 8;
            bytes.push((waiting.0 >> waiting.1) as u8);
        }
    }
    bytes
}

/// A picture's directory: size, bits and number of samples, compression, what its numbers are.
fn picture(
    [width, height]: [usize; 2],
    bits: u16,
    samples: usize,
    compression: u16,
    photometric: u16,
) -> Directory {
    vec![
        (254, Long(vec![0])),
        (256, Long(vec![width as u32])),
        (257, Long(vec![height as u32])),
        (258, Short(vec![bits; samples])),
        (259, Short(vec![compression])),
        (262, Short(vec![photometric])),
        (277, Short(vec![samples as u16])),
    ]
}

const MOSAIC: u16 = 32803;
const LINEAR: u16 = 34892;

/// What says that a file is a DNG, and which camera it is of.
fn of_dng() -> Directory {
    vec![
        (50706, Byte(vec![1, 4, 0, 0])),
        (50707, Byte(vec![1, 1, 0, 0])),
        (271, Ascii("Canon")),
        (272, Ascii("Canon EOS 5D Mark II")),
        (274, Short(vec![1])),
    ]
}

/// Filters that begin with red, then green.
fn filters() -> Directory {
    vec![(33421, Short(vec![2, 2])), (33422, Byte(vec![0, 1, 1, 2]))]
}

/// A mosaic of 16 bits in one strip, black 0, white 4000.
fn plain(numbers: &[u16]) -> Directory {
    [
        of_dng(),
        picture([WIDTH, HEIGHT], 16, 1, 1, MOSAIC),
        filters(),
        vec![(278, Long(vec![HEIGHT as u32])), (50717, Long(vec![4000]))],
        pieces(STRIPS, vec![packed(numbers, 16, false)]),
    ]
    .concat()
}

fn with(mut directory: Directory, tags: Directory) -> Directory {
    directory.retain(|(tag, _)| tags.iter().all(|(other, _)| other != tag));
    [directory, tags].concat()
}

fn saved(folder: &TempDir, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join("photo.dng");
    std::fs::write(&path, bytes).unwrap();
    path
}

/// What each of eight facets is measured as, for each half of the picture that they are in.
fn facets(path: &Path) -> Vec<(usize, Vec<f64>)> {
    let photograph = Photograph::open(path, &ReadOptions::default()).unwrap();
    let grid = |(panel, corners): (usize, [[f64; 2]; 4])| {
        let corners = corners.map(|[x, y]| Point::new(x, y));
        Grid { panel: Some(panel), ..Grid::even(Homography::from_unit_square(corners).unwrap(), [2, 2]) }
    };
    let grids: Vec<_> = PANELS.into_iter().enumerate().map(grid).collect();
    let measured = measure(&photograph, &grids, 0.0).unwrap();
    measured.into_iter().enumerate().map(|(k, facet)| (k / 4, facet.mean.unwrap())).collect()
}

/// The facets are those that were written, to half a step of the stored numbers.
fn assert_written(bytes: &[u8], step: f64) {
    let folder = tempfile::tempdir().unwrap();
    for (half, mean) in facets(&saved(&folder, bytes)) {
        let off = mean.iter().zip(LIGHT[half]).map(|(got, want)| (got - want).abs()).fold(0.0, f64::max);
        assert!(off < 0.51 * step, "{mean:?}, not {:?}", LIGHT[half]);
    }
}

/// The message of a file that must be refused, in one line.
fn refusal(bytes: &[u8]) -> String {
    let error = Photograph::open(&saved(&tempfile::tempdir().unwrap(), bytes), &ReadOptions::default());
    let error = error.unwrap_err();
    let message = error.to_string();
    assert!(error.exit_status() == 1 && !message.contains('\n'), "{message}");
    message
}

/// A list of opcodes, each not to be left out.
fn opcodes(opcodes: &[(u32, Vec<u8>)]) -> Vec<u8> {
    let mut list = (opcodes.len() as u32).to_be_bytes().to_vec();
    for (id, parameters) in opcodes {
        list.extend([*id, 0x0103_0000, 0, parameters.len() as u32].into_iter().flat_map(u32::to_be_bytes));
        list.extend(parameters);
    }
    list
}

/// A map of 2 x 3 gains over the whole picture, for every other row and column from these on.
fn gain_map([row, column]: [u32; 2], gain: impl Fn(f64, f64) -> f64) -> (u32, Vec<u8>) {
    let area = [row, column, HEIGHT as u32, WIDTH as u32, 0, 1, 2, 2, 2, 3];
    let mut bytes: Vec<u8> = area.into_iter().flat_map(u32::to_be_bytes).collect();
    bytes.extend([1.0, 0.5, 0.0, 0.0].into_iter().flat_map(f64::to_be_bytes));
    bytes.extend(1_u32.to_be_bytes());
    let points = [0.0, 1.0].into_iter().flat_map(|down| [0.0, 0.5, 1.0].map(|right| (down, right)));
    bytes.extend(points.flat_map(|(down, right)| (gain(down, right) as f32).to_be_bytes()));
    (9, bytes)
}

// ---- layouts ----

/// A thumbnail first, then the mosaic in tiles of lossless JPEG, two numbers a pixel of theirs, then a
/// preview; big end first. Levels begin at the active area's corner, the picture a little within.
#[test]
fn a_converters_mosaic_in_tiles() {
    const SENSOR: [usize; 2] = [WIDTH + 12, HEIGHT + 8];
    const BLACK: [f64; 4] = [1020.0, 1024.0, 1028.0, 1023.0];
    // two columns and four rows that see no light, then four and two beyond the picture
    let number = |x: usize, y: usize| {
        let light = light(x.saturating_sub(6).min(WIDTH - 1), bayer(x, y));
        (BLACK[x % 2 + y % 2 * 2] + light * (15000.0 - 1028.0)).round() as u16
    };
    let tiles = (0..SENSOR[1].div_ceil(32))
        .flat_map(|row| (0..SENSOR[0].div_ceil(32)).map(move |column| [row, column]));
    let tiles = tiles.map(|[row, column]| {
        let places =
            (32 * row..32 * (row + 1)).flat_map(|y| (32 * column..32 * (column + 1)).map(move |x| (x, y)));
        let numbers: Vec<u16> = places.map(|(x, y)| number(x, y)).collect();
        lossless_jpeg::encode([16, 32, 2, 16], &numbers)
    });
    let raw = [
        picture(SENSOR, 16, 1, 7, MOSAIC),
        filters(),
        vec![
            (322, Long(vec![32])),
            (323, Long(vec![32])),
            (50713, Short(vec![2, 2])),
            (50714, Rational(BLACK.map(|black| [black as u32 * 256, 256]).to_vec())),
            (50717, Short(vec![15000])),
            (50719, Rational(vec![[4, 1], [2, 1]])),
            (50720, Rational(vec![[WIDTH as u32, 1], [HEIGHT as u32, 1]])),
            (50829, Long(vec![4, 2, SENSOR[1] as u32, SENSOR[0] as u32])),
        ],
        pieces(TILES, tiles.collect()),
    ];
    let small = |size: [usize; 2]| {
        let strip = pieces(STRIPS, vec![vec![99; 3 * size[0] * size[1]]]);
        with([picture(size, 8, 3, 1, 2), strip].concat(), vec![(254, Long(vec![1]))])
    };
    let first =
        [of_dng(), small([8, 6]), vec![(SUB_DIRECTORIES, Directories(vec![raw.concat(), small([16, 12])]))]];
    assert_written(&tiff(first.concat(), true), 1.0 / 13972.0);
}

/// A mosaic in strips, the last one shorter, and the shading of the lens in four maps of gains, one for each
/// site of the mosaic's square.
#[test]
fn a_phones_mosaic_with_gain_maps() {
    let gain =
        |colour: usize, down: f64, right: f64| 1.0 + (1.0 + colour as f64) * (0.25 * down + 0.5 * right);
    let numbers = sites(WIDTH, HEIGHT, |x, y, light| {
        let [right, down] = [(x as f64 + 0.5) / WIDTH as f64, (y as f64 + 0.5) / HEIGHT as f64];
        1000.0 + 50000.0 * light / gain(bayer(x, y), down, right)
    });
    let maps = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[row, column]| {
        let colour = bayer(column as usize, row as usize);
        gain_map([row, column], move |down, right| gain(colour, down, right))
    });
    // some writers fill strips up
    let strips =
        numbers.chunks(7 * WIDTH).map(|rows| [packed(rows, 16, false), vec![99; 6]].concat()).collect();
    let raw = with(
        plain(&numbers),
        [
            vec![
                (278, Long(vec![7])),
                (50714, Short(vec![1000])),
                (50717, Long(vec![51000])),
                (51009, Undefined(opcodes(&maps))),
            ],
            pieces(STRIPS, strips),
        ]
        .concat(),
    );
    assert_written(&tiff(raw, false), 4.0 / 50000.0);
}

/// Three samples a pixel in strips of lossless JPEG that follow one another, one black level and three white
/// ones; beside them a mask and a picture that a program made.
#[test]
fn linear_colours_with_masks() {
    let white = [3800.0, 3900.0, 4000.0];
    let row: Vec<u16> = (0..WIDTH)
        .flat_map(|x| {
            (0..3).map(move |colour| (500.0 + light(x, colour) * (white[colour] - 500.0)).round() as u16)
        })
        .collect();
    let strips = (0..HEIGHT.div_ceil(16)).map(|n| {
        let rows = 16.min(HEIGHT - 16 * n);
        lossless_jpeg::encode([WIDTH, rows, 3, 12], &row.repeat(rows))
    });
    let raw = [
        picture([WIDTH, HEIGHT], 12, 3, 7, LINEAR),
        vec![
            (278, Long(vec![16])),
            (50714, Short(vec![500])),
            (50717, Short(white.map(|white| white as u16).to_vec())),
        ],
        pieces(STRIPS, strips.collect()),
    ];
    let other = |kind: u32, photometric: u16, samples: usize| {
        let strip = pieces(STRIPS, vec![vec![7; samples * 6 * 8]]);
        with([picture([8, 6], 8, samples, 1, photometric), strip].concat(), vec![(254, Long(vec![kind]))])
    };
    let others = vec![other(0x1_0004, 52527, 1), other(0x1_0000, LINEAR, 3), raw.concat(), other(4, 4, 1)];
    let first = [of_dng(), other(1, 2, 3), vec![(SUB_DIRECTORIES, Directories(others))]];
    assert_written(&tiff(first.concat(), false), 1.0 / 3300.0);
}

/// Floats in tiles, by Deflate and the difference of bytes of one significance, with no white level: 1.
#[test]
fn floats_of_several_exposures() {
    let tile = |column: usize| {
        let row = |y: usize| -> Vec<u8> {
            let floats = (0..40).map(|x| light(40 * column + x, bayer(x, y)) as f32);
            let bytes: Vec<_> = floats.map(f32::to_be_bytes).collect();
            let by_significance: Vec<u8> =
                (0..4).flat_map(|n| bytes.iter().map(move |bytes| bytes[n])).collect();
            let before = [0].into_iter().chain(by_significance.iter().copied());
            by_significance.iter().zip(before).map(|(byte, before)| byte.wrapping_sub(before)).collect()
        };
        stored((0..HEIGHT).flat_map(row).collect())
    };
    let raw = [
        of_dng(),
        picture([WIDTH, HEIGHT], 32, 1, 8, MOSAIC),
        filters(),
        vec![
            (317, Short(vec![3])),
            (322, Long(vec![40])),
            (323, Long(vec![HEIGHT as u32])),
            (339, Short(vec![3])),
        ],
        pieces(TILES, vec![tile(0), tile(1)]),
    ];
    assert_written(&tiff(raw.concat(), false), 1e-6);
}

/// Bytes in zlib's format, as they are.
fn stored(bytes: Vec<u8>) -> Vec<u8> {
    let (mut low, mut high) = (1_u32, 0);
    for byte in &bytes {
        low = (low + u32::from(*byte)) % 65521;
        high = (high + low) % 65521;
    }
    let length = bytes.len() as u16;
    let head = [&[0x78, 1, 1][..], &length.to_le_bytes(), &(!length).to_le_bytes()].concat();
    [head, bytes, (high << 16 | low).to_be_bytes().to_vec()].concat()
}

/// Ten bits a number, which stand for others by a table.
#[test]
fn packed_numbers_with_a_linearization() {
    let table = (0..1024).map(|number| 100 + 16 * number).collect();
    let numbers = sites(WIDTH, HEIGHT, |_, _, light| 1000.0 * light);
    let raw = with(
        plain(&numbers),
        [
            vec![
                (258, Short(vec![10])),
                (50712, Short(table)),
                (50714, Short(vec![100])),
                (50717, Long(vec![16100])),
            ],
            pieces(STRIPS, vec![packed(&numbers, 10, false)]),
        ]
        .concat(),
    );
    assert_written(&tiff(raw, false), 1e-3);
}

/// A quarter of the picture for each site of the mosaic's square, as they are before JPEG XL: even rows
/// first, even columns to the left.
#[test]
fn a_mosaic_in_quarters() {
    let numbers = sites(WIDTH, HEIGHT, |_, _, light| 4000.0 * light);
    let place = |at: usize, size: usize| at % (size / 2) * 2 + at / (size / 2);
    let quarters: Vec<u16> = (0..WIDTH * HEIGHT)
        .map(|n| numbers[place(n / WIDTH, HEIGHT) * WIDTH + place(n % WIDTH, WIDTH)])
        .collect();
    let raw = with(plain(&quarters), INTERLEAVE.map(|tag| (tag, Short(vec![2]))).to_vec());
    assert_written(&tiff(raw, false), 1.0 / 4000.0);
}

/// Black is the sum of a pattern's level, the column's and the row's; white is one above the highest of them.
#[test]
fn black_levels_by_column_and_row() {
    const BLACK: [f64; 4] = [10.0, 20.0, 30.0, 40.0];
    let by_column = |x: usize| (x % 5) as i32 * 8 - 16;
    let by_row = |y: usize| (y % 3) as i32 * 25;
    // where a column of +16, a row of +50 and the pattern's 40 meet
    let highest = 40.0 + 16.0 + 50.0;
    let numbers = sites(WIDTH, HEIGHT, |x, y, light| {
        let black = BLACK[x % 2 + 2 * (y % 2)] + f64::from(by_column(x) + by_row(y));
        black.max(0.0) + light * (4000.0 - highest)
    });
    let ratios =
        |size: usize, of: &dyn Fn(usize) -> i32| SignedRational((0..size).map(|k| [2 * of(k), 2]).collect());
    let tags = vec![
        (50713, Short(vec![2, 2])),
        (50714, Short(BLACK.map(|black| black as u16).to_vec())),
        (50715, ratios(WIDTH, &by_column)),
        (50716, ratios(HEIGHT, &by_row)),
    ];
    assert_written(&tiff(with(plain(&numbers), tags.clone()), false), 2.0 / 3894.0);
    let short = with(tags, vec![(50716, ratios(HEIGHT - 1, &by_row))]);
    assert!(
        refusal(&tiff(with(plain(&numbers), short), false))
            .contains("BlackLevelDeltaV has 59 numbers for 60 rows")
    );
}

/// A Pentax's own file, big end first, uncompressed, with its black levels among its notes and more sensor
/// than picture.
#[test]
fn a_pentax() {
    let [left, top, right, bottom] = [8, 8, 56, 24]; // as rawler knows a K10D
    let [width, height] = [WIDTH + left + right, HEIGHT + top + bottom];
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let number = |(x, y): (usize, usize)| {
        (120.0 + light(x.saturating_sub(left).min(WIDTH - 1), bayer(x, y)) * (4095.0 - 120.0)).round() as u16
    };
    let numbers: Vec<u16> = places.map(number).collect();
    // a directory of one entry, the black point behind the numbers, which follow make and model
    let mut notes = b"AOC\0MM\0\x01\x02\0\0\x03\0\0\0\x04".to_vec();
    notes.extend((40 + 2 * numbers.len() as u32).to_be_bytes());
    notes.extend([0; 4]);
    let strip = [packed(&numbers, 16, true), [0, 120].repeat(4)].concat();
    let first = [
        vec![(34665, Directories(vec![vec![(37500, Undefined(notes))]]))],
        picture([width, height], 16, 1, 1, MOSAIC),
        pieces(STRIPS, vec![strip]),
        vec![(271, Ascii("PENTAX Corporation")), (272, Ascii("PENTAX K10D"))],
    ];
    assert_written(&tiff(first.concat(), true), 1.0 / 3975.0);
}

/// A Mamiya's own file: twelve bits a number, a preview first.
#[test]
fn a_mamiya() {
    let numbers = sites(WIDTH, HEIGHT, |_, _, light| 4000.0 * light);
    let raw = [
        picture([WIDTH, HEIGHT], 12, 1, 1, MOSAIC),
        filters(),
        pieces(STRIPS, vec![packed(&numbers, 12, true)]),
    ];
    let first = [
        with(picture([8, 6], 8, 3, 1, 2), vec![(254, Long(vec![1]))]),
        pieces(STRIPS, vec![vec![99; 3 * 8 * 6]]),
        vec![(271, Ascii("Mamiya-OP Co.,Ltd.")), (272, Ascii("MAMIYA ZD"))],
        vec![(SUB_DIRECTORIES, Directories(vec![raw.concat()]))],
    ];
    assert_written(&tiff(first.concat(), true), 1.0 / 4000.0);
}

// ---- what is refused ----

/// What the decoder does not unpack rightly is not called damaged.
#[test]
fn what_is_not_read_is_said_to_be_that() {
    let numbers = sites(WIDTH, HEIGHT, |_, _, light| 4000.0 * light);
    let changed = |tags: Directory| tiff(with(plain(&numbers), tags), false);
    let quarters = |tags: Directory| [INTERLEAVE.map(|tag| (tag, Short(vec![2]))).to_vec(), tags].concat();
    let pages = vec![(SUB_DIRECTORIES, Directories(vec![plain(&numbers)]))];
    for (tags, says) in [
        (vec![(254, Long(vec![1]))], "without a picture"),
        (pages, "2 main pictures"),
        (vec![(259, Short(vec![52546]))], "lossy JPEG XL"),
        (vec![(259, Short(vec![34892]))], "lossy JPEG"),
        (vec![(259, Short(vec![8]))], "compression 8"),
        (vec![(258, Short(vec![32]))], "integers of 32 bits"),
        (vec![(339, Short(vec![2]))], "signed"),
        (vec![(266, Short(vec![2]))], "FillOrder 2"),
        (vec![(50707, Byte(vec![1, 8, 0, 0]))], "version 1.8"),
        (vec![(50711, Short(vec![2]))], "CFALayout"),
        (vec![(50974, Short(vec![2, 2]))], "SubTileBlockSize"),
        (vec![(INTERLEAVE[0], Short(vec![3]))], "interleaved"),
        (quarters(vec![(258, Short(vec![32])), (339, Short(vec![3]))]), "interleaved"),
        (quarters(vec![(262, Short(vec![LINEAR])), (277, Short(vec![3]))]), "interleaved"),
        (quarters(vec![(256, Long(vec![WIDTH as u32 - 1]))]), "interleaved"),
        (quarters(vec![(257, Long(vec![HEIGHT as u32 - 1]))]), "interleaved"),
        (
            vec![(262, Short(vec![LINEAR])), (277, Short(vec![3])), (284, Short(vec![2]))],
            "PlanarConfiguration 2",
        ),
    ] {
        let message = refusal(&changed(tags));
        assert!(message.contains("this vfold does not read DNG") && message.contains(says), "{message}");
        assert!(!message.contains("damaged"), "{message}");
    }
    let eight_bits = lossless_jpeg::encode([WIDTH, HEIGHT, 1, 8], &vec![99; WIDTH * HEIGHT]);
    let tags = [vec![(259, Short(vec![7]))], pieces(STRIPS, vec![eight_bits])].concat();
    assert!(refusal(&changed(tags)).contains("lossless JPEG of 8 bits"));
    let floats =
        vec![(258, Short(vec![32])), (259, Short(vec![8])), (317, Short(vec![3])), (339, Short(vec![3]))];
    let strips = [40, 20].map(|rows| stored(vec![0; rows * WIDTH * 4])).to_vec();
    let tags = [floats, vec![(278, Long(vec![40]))], pieces(STRIPS, strips)].concat();
    assert!(refusal(&changed(tags)).contains("Deflate whose last strip has fewer rows than the others"));
    let wide = vec![(50718, Rational(vec![[2, 1], [1, 1]]))];
    assert!(refusal(&changed(wide)).contains("by its DefaultScale, its pixels are 2 times as wide as high"));
    let full =
        [picture([WIDTH, HEIGHT], 16, 1, 1, 1), pieces(STRIPS, vec![packed(&numbers, 16, false)])].concat();
    let small = with(picture([1, 1], 8, 1, 1, 1), vec![(254, Long(vec![1]))]);
    let both =
        [small, vec![(SUB_DIRECTORIES, Directories(vec![full]))], pieces(STRIPS, vec![vec![0]])].concat();
    let message = refusal(&tiff(both, false));
    assert!(message.contains("keeps its full picture in a sub-directory (SubIFD)"), "{message}");
    assert!(!message.contains("damaged"), "{message}");
    let cut = vec![(279, Long(vec![1 << 20]))];
    assert!(refusal(&changed(cut)).contains("not all in the file"));
    let levels = vec![(50714, Short(vec![1, 2, 3]))];
    assert!(refusal(&changed(levels)).contains("BlackLevel"));
}

// ---- through vextract ----

/// The three files that were read without their tags, measured as a user does.
#[test]
fn vextract_measures_what_the_tags_say() {
    let rows = vec![(50716, SignedRational(vec![[256, 1]; HEIGHT])), (50717, Long(vec![4056]))];
    let black = with(plain(&sites(WIDTH, HEIGHT, |_, _, light| 256.0 + 3800.0 * light)), rows);
    let maps = [([0, 0], 2.0), ([0, 1], 1.25), ([1, 0], 1.25), ([1, 1], 1.5)];
    let gain = |x: usize, y: usize| maps[x % 2 + y % 2 * 2].1;
    let shaded = sites(WIDTH, HEIGHT, |x, y, light| 4000.0 * light / gain(x, y));
    let maps = maps.map(|(from, gain)| gain_map(from, move |_, _| gain));
    let shaded = with(plain(&shaded), vec![(51009, Undefined(opcodes(&maps)))]);
    let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let floats = places.flat_map(|(x, y)| (light(x, bayer(x, y)) as f32).to_le_bytes()).collect();
    let mut float = plain(&[]);
    float.retain(|(tag, _)| *tag != 50717);
    let float = with(
        float,
        [vec![(258, Short(vec![32])), (339, Short(vec![3]))], pieces(STRIPS, vec![floats])].concat(),
    );
    for (name, directory) in [("black", black), ("shaded", shaded), ("float", float)] {
        let folder = Workdir::new();
        std::fs::write(folder.path().join("photo.dng"), tiff(directory, false)).unwrap();
        let run = folder.sh("vkernel --angle-deg 50 --facets 2x2 -o scene.json
            vextract photo.dng --scene scene.json --camera canon-5d-mark-ii --illuminant D65 \\
                --panel0 '40,55 40,5 5,10 5,50' --panel1 '40,55 40,5 75,10 75,50'");
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{name}");
        let sample: Json = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
        for (k, mean) in sample["facet_rgb"].as_array().unwrap().iter().enumerate() {
            for (colour, got) in mean.as_array().unwrap().iter().enumerate() {
                let off = (got.as_f64().unwrap() - LIGHT[k / 4][colour]).abs();
                assert!(off < 3e-4, "{name}: facet {k}, {mean}");
            }
        }
    }
}
