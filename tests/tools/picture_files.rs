//! Files of pictures as other programs write them, through `vextract`: two halves of known colours, the
//! facets of either panel.

use serde_json::Value;

use crate::common::{Ended, Workdir, is_there};

const FILES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/bugs");
/// `extract`, and `halves` with so many channels in so many samples.
const SETUP: &str = r#"
    vkernel --angle-deg 50 -o scene.json
    corners0="40,55 40,5 5,10 5,50" corners1="40,55 40,5 75,10 75,50"
    extract() {
        vextract "$@" --scene scene.json --panel0 "$corners0" --panel1 "$corners1"
    }
    of_canon() {
        extract "$@" --camera canon-5d-mark-ii --illuminant D65
    }
    halves() {
        oiiotool --create 80x60 3 --fill:color=.2,.4,.1 40x60 --fill:color=.3,.15,.25 40x60+40+0 "$@"
    }
"#;
const COLOURS: [[f64; 3]; 2] = [[0.2, 0.4, 0.1], [0.3, 0.15, 0.25]];

fn sh(folder: &Workdir, line: &str) -> Ended {
    folder.sh(&format!("{SETUP}\n{line}"))
}

fn sample(run: &Ended) -> Value {
    assert_eq!(run.status, 0, "{}", run.stderr);
    serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap()
}

/// Asserts that all facets have the colours of their halves.
fn assert_halves(run: &Ended, tolerance: f64, what: &str) {
    let sample = sample(run);
    let facets = sample["facet_rgb"].as_array().unwrap();
    for (n, facet) in facets.iter().enumerate() {
        let want = COLOURS[2 * n / facets.len()];
        let got: Vec<f64> = facet.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
        assert!(
            got.iter().zip(want).all(|(got, want)| (got - want).abs() < tolerance),
            "{what}, {n}: {got:?} {want:?}"
        );
    }
}

#[test]
fn files_of_other_programs_are_read_as_they_are_meant() {
    if !is_there(FILES) {
        return;
    }
    let folder = Workdir::new();
    for name in ["rgb_two_extra_samples.tif", "planes_in_tiles.tif", "encoded_srgb_by_color_interop_id.exr"] {
        assert_halves(&sh(&folder, &format!("of_canon {FILES}/{name}")), 2e-3, name);
    }
}

#[test]
fn layouts_of_tiff_are_read_or_refused_by_name() {
    let folder = Workdir::new();
    for (name, how) in [
        ("more samples", "--ch R,G,B,=.7,=.3 -d uint16 --compression zip"),
        ("planes in tiles", "--tile 32 32 --planarconfig separate -d uint16 --compression none"),
        ("LZW in tiles", "--tile 32 32 --compression lzw -d uint16"),
        ("half", "-d half --attrib:type=int tiff:half 1"),
        ("planes of floats", "--planarconfig separate -d float --compression lzw"),
    ] {
        assert_halves(&sh(&folder, &format!("halves {how} -o a.tif; of_canon a.tif")), 1e-3, name);
    }
    // what was made small stands before what is meant, or behind it
    let run = sh(
        &folder,
        "halves -d uint16 -o a.tif; oiiotool a.tif --resize 40x30 -o small.tif
        oiiotool a.tif small.tif --siappend -d uint16 -o first.tif; of_canon first.tif",
    );
    assert_halves(&run, 1e-3, "several pages");
    assert_eq!(sample(&run)["image"]["notes"][0], "TIFF: it has 2 pages, of which the first is read");
    let run = sh(&folder, "oiiotool small.tif a.tif --siappend -d uint16 -o last.tif; of_canon last.tif");
    assert_eq!(
        (run.status, run.stderr.as_str()),
        (
            1,
            "vextract: last.tif: its first page is 40 x 30 px, but a later one 80 x 60 px; \
             save the intended page alone\n"
        )
    );
    for (how, why) in [("-d uint32", "integers of 32 bits"), ("-d uint8 --compression jpeg", "YCbCr")] {
        let run = sh(&folder, &format!("halves {how} -o a.tif; of_canon a.tif"));
        let is_named = run.stderr.contains("this vfold does not read TIFF with ") && run.stderr.contains(why);
        assert!(run.status == 1 && is_named, "{how}: {run:?}");
    }
}

/// A TIFF of 16 bits whose halves have these samples, with more tags of one or more numbers of 16 bits.
fn tiff(halves: [&[u16]; 2], tags: &[(u16, &[u16])]) -> Vec<u8> {
    const SIZE: [u16; 2] = [80, 60];
    let samples = halves[0].len() as u16;
    let row = halves.map(|half| half.repeat(40)).concat();
    let pixels: Vec<u8> = row.repeat(60).iter().flat_map(|sample| sample.to_le_bytes()).collect();
    let bits = vec![16; halves[0].len()];
    let strip = [pixels.len() as u16, (pixels.len() >> 16) as u16];
    let mut entries: Vec<(u16, &[u16])> = vec![
        (256, &SIZE[..1]),
        (257, &SIZE[1..]),
        (258, &bits),
        (259, &[1]),
        (262, &[2]),
        (273, &[8]),
        (277, std::slice::from_ref(&samples)),
        (278, &SIZE[1..]),
        (279, &strip),
    ];
    entries.extend(tags);
    entries.sort_by_key(|(tag, _)| *tag);
    let at = 8 + pixels.len() as u32;
    let mut behind_at = at + 6 + 12 * entries.len() as u32;
    let (mut directory, mut behind) = ((entries.len() as u16).to_le_bytes().to_vec(), Vec::new());
    for (tag, numbers) in entries {
        // the length of the strip is one of 32 bits
        let (kind, count) = if tag == 279 { (4_u16, 1) } else { (3, numbers.len() as u32) };
        let mut value: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        if value.len() > 4 {
            behind.extend(&value);
            value = behind_at.to_le_bytes().to_vec();
            behind_at += 2 * count;
        }
        value.resize(4, 0);
        directory
            .extend([&tag.to_le_bytes()[..], &kind.to_le_bytes(), &count.to_le_bytes(), &value].concat());
    }
    directory.extend([0; 4]);
    [&b"II*\0"[..], &at.to_le_bytes(), &pixels, &directory, &behind].concat()
}

/// The stored numbers of the two halves, multiplied.
fn stored(factor: f64, more: &[u16]) -> [Vec<u16>; 2] {
    COLOURS.map(|colour| {
        let colour = colour.map(|value| (65535.0 * factor * value).round() as u16);
        [&colour[..], more].concat()
    })
}

#[test]
fn colours_multiplied_by_alpha_are_divided_again() {
    let folder = Workdir::new();
    for (name, how) in [
        ("OpenEXR", "-d half -o a.exr; of_canon a.exr"),
        ("PNG, which does not multiply", "-d uint16 -o a.png; of_canon a.png"),
        ("TIFF", "-d uint16 -o a.tif; of_canon a.tif"),
        ("TIFF of floats in planes", "--planarconfig separate -d float -o b.tif; of_canon b.tif"),
    ] {
        let line = format!("halves --ch R,G,B,A=.5 --mulc .5,.5,.5,1 {how}");
        assert_halves(&sh(&folder, &line), 1e-3, name);
    }
    const ALPHA: u16 = 0x4000;
    let quarter = f64::from(ALPHA) / 65535.0;
    for (extra, factor) in [(1, quarter), (2, 1.0)] {
        let [left, right] = stored(factor, &[ALPHA]);
        std::fs::write(folder.path().join("c.tif"), tiff([&left, &right], &[(338, &[extra])])).unwrap();
        assert_halves(&sh(&folder, "of_canon c.tif"), 1e-3, &format!("ExtraSamples {extra}"));
    }
    let [left, right] = stored(1.0, &[ALPHA]);
    std::fs::write(folder.path().join("d.tif"), tiff([&left, &right], &[(338, &[1])])).unwrap();
    let run = sh(&folder, "of_canon d.tif");
    assert!(run.status == 1 && run.stderr.contains("d.tif: a colour is above alpha"), "{run:?}");
    let run = sh(&folder, "halves --ch R,G,B,A=255 -d half -o id.exr; of_canon id.exr");
    assert_eq!(
        (run.status, run.stderr.as_str()),
        (
            1,
            "vextract: id.exr: its alpha is 255 somewhere, not between 0 and 1; save it without alpha, as R, \
             G and B\n"
        )
    );
}

#[test]
fn black_and_white_that_a_tiff_states_are_confirmed_by_the_user() {
    let folder = Workdir::new();
    let extract = |tags: &[(u16, &[u16])], flags: &str| {
        let [left, right] = stored(0.5, &[]);
        std::fs::write(folder.path().join("a.tif"), tiff([&left, &right], tags)).unwrap();
        sh(&folder, &format!("of_canon a.tif {flags}"))
    };
    let half = [0, 32768].repeat(3);
    for (tags, says) in [
        (&[(532, &half[..])][..], "by its ReferenceBlackWhite, white is 32768 instead of 65535"),
        (&[(50717, &[32768])], "by its WhiteLevel, white is 32768 instead of 65535"),
        (
            &[(50714, &[0, 512, 512]), (50717, &[65535])],
            "by its BlackLevel and WhiteLevel, black is 0, 512 instead of 0",
        ),
    ] {
        let run = extract(tags, "");
        assert!(run.status == 1 && run.stderr.contains(&format!("a.tif: {says}; ")), "{run:?}");
    }
    assert_halves(&extract(&[(532, &half)], "--white-level 32768"), 1e-3, "as it says");
    let whole = [0, 65535].repeat(3);
    assert_eq!(extract(&[(532, &whole), (50714, &[0])], "").status, 0, "as assumed");
}

/// The first directory of a little-endian TIFF: its place, and its entries.
fn first_directory(tiff: &[u8]) -> (usize, Vec<[u8; 12]>) {
    let at = u32::from_le_bytes(tiff[4..8].try_into().unwrap()) as usize;
    let count = usize::from(u16::from_le_bytes([tiff[at], tiff[at + 1]]));
    (at, tiff[at + 2..].chunks_exact(12).take(count).map(|entry| entry.try_into().unwrap()).collect())
}

fn directory(mut entries: Vec<[u8; 12]>) -> Vec<u8> {
    entries.sort_by_key(|entry| u16::from_le_bytes([entry[0], entry[1]]));
    [&(entries.len() as u16).to_le_bytes()[..], &entries.concat(), &[0; 4]].concat()
}

/// An entry whose value is a single number.
fn entry(tag: u16, kind: u16, value: usize) -> [u8; 12] {
    let parts = [&tag.to_le_bytes()[..], &kind.to_le_bytes(), &[1, 0, 0, 0], &(value as u32).to_le_bytes()];
    parts.concat().try_into().unwrap()
}

/// EXIF that calls the numbers those of sRGB, in places where programs put it.
#[test]
fn exif_is_found_wherever_a_tiff_has_it() {
    const FAR: usize = 2 << 20;
    let folder = Workdir::new();
    let exif = directory(vec![entry(0xa001, 3, 1)]);
    let [left, right] = stored(1.0, &[]);
    // EXIF and first directory behind far more than the pixels, and more behind them
    let mut far = tiff([&left, &right], &[]);
    let (_, mut entries) = first_directory(&far);
    far.resize(FAR, 0xff);
    far.extend(&exif);
    entries.push(entry(0x8769, 4, FAR));
    far.resize(2 * FAR, 0xff);
    far.extend(directory(entries));
    far.resize(3 * FAR, 0xff);
    far[4..8].copy_from_slice(&(2 * FAR as u32).to_le_bytes());
    // EXIF of the second page, before which a small copy is announced
    let mut paged = tiff([&left, &right], &[(254, &[1])]);
    let (at, mut entries) = first_directory(&paged);
    let end = at + 2 + 12 * entries.len();
    entries.retain(|entry| entry[..2] != 254_u16.to_le_bytes());
    let exif_at = paged.len();
    paged.extend(&exif);
    let second_at = paged.len() as u32;
    paged[end..end + 4].copy_from_slice(&second_at.to_le_bytes());
    entries.push(entry(0x8769, 13, exif_at));
    paged.extend(directory(entries));
    for (what, bytes) in [("far away", far), ("of the page", paged)] {
        std::fs::write(folder.path().join("a.tif"), bytes).unwrap();
        let sample = sample(&sh(&folder, "of_canon a.tif"));
        assert_eq!(sample["image"]["transfer"], "srgb", "{what}");
    }
}

/// Channels of OpenEXR that are not red, green and blue.
#[test]
fn other_channels_are_named() {
    let folder = Workdir::new();
    for (channels, what) in [
        ("X,Y,Z", "a picture of CIE XYZ (channels X, Y and Z)"),
        ("Y,RY,BY", "a picture of luminance and chroma"),
        ("Y,id,mask", "a picture of luminance (Y)"),
    ] {
        let run = sh(&folder, &format!("halves --chnames {channels} -d half -o a.exr; of_canon a.exr"));
        assert!(run.status == 1 && run.stderr.contains(what), "{run:?}");
    }
}

/// A pipe can be read once.
#[test]
fn pipes_are_read_as_the_files_they_carry() {
    let folder = Workdir::new();
    let run = sh(
        &folder,
        r#"
        without_file() {
            tail -n 1 | sed 's/"id":"[^"]*"//; s/"file":"[^"]*",//; s/"file_[a-z_]*":[0-9.e]*,//g
                s/"sha256":"[0-9a-f]*",*//'
        }
        halves -d uint16 -o a.tif
        halves -d half -o a.exr
        halves -d uint16 -o a.png
        mkfifo pipe
        for file in a.tif a.exr a.png; do
            of_canon $file | without_file > of_file
            cat $file > pipe & of_canon pipe | without_file > of_pipe
            cmp of_file of_pipe
            cat $file > pipe & of_canon $file --white pipe > of_white
            of_canon $file --white $file | tail -n 1 > white
            tail -n 1 of_white | cmp - white
        done
        cat a.tif > pipe & of_canon pipe --preview preview.png
        "#,
    );
    assert_eq!((run.status, run.stderr.as_str(), run.stdout.as_str()), (0, "", ""));
    if folder.can("bash -c :", "pictures of <(...) are not tested") {
        let run = sh(
            &folder,
            r#"bash -ec 'vextract <(cat a.tif) --scene scene.json --camera canon-5d-mark-ii --illuminant D65 \
                --panel0 "40,55 40,5 5,10 5,50" --panel1 "40,55 40,5 75,10 75,50"'"#,
        );
        assert_halves(&run, 1e-3, "<(cat a.tif)");
        let run = sh(&folder, "bash -ec 'vextract <(echo no picture) --preview a.png'");
        assert!(run.status == 1 && run.stderr.contains("not a PNG, TIFF"), "{run:?}");
    }
}

/// A picture that is replaced while a run rests is measured again, which is said; the file is that of one
/// run.
#[test]
fn replaced_pictures_are_measured_again() {
    let folder = Workdir::new();
    let run = sh(
        &folder,
        "for n in 1 2 3; do halves -d uint16 -o $n.tif; done
        of_canon 1.tif 2.tif 3.tif --resume out.ndjson
        of_canon 1.tif 2.tif 3.tif --resume out.ndjson
        oiiotool 2.tif --mulc .5 -d uint16 -o 2.tif
        touch -d 2020-01-01 2.tif
        of_canon 1.tif 2.tif 3.tif --resume out.ndjson
        of_canon 1.tif 2.tif 3.tif > whole.ndjson
        cmp out.ndjson whole.ndjson
        touch -d 2021-01-01 1.tif
        extract 1.tif --no-history --camera canon-5d-mark-ii --illuminant D65 --resume one.ndjson
        touch -d 2022-01-01 1.tif
        extract 1.tif --no-history --camera canon-5d-mark-ii --illuminant D65 --resume one.ndjson",
    );
    let again = |name: &str| {
        format!(
            "vextract: {name} has changed since it was measured: it and all later photographs are measured \
             again\n"
        )
    };
    assert_eq!((run.status, run.stderr), (0, again("2.tif") + &again("1.tif")));
}

/// Systems write é as one letter or as two.
#[test]
fn composed_and_decomposed_names_are_one() {
    let folder = Workdir::new();
    let run = sh(
        &folder,
        r#"
        composed=$(printf 'caf\303\251') decomposed=$(printf 'cafe\314\201')
        halves -d uint16 -o $decomposed.tif
        corners='"panel0": [[40,55],[40,5],[5,10],[5,50]], "panel1": [[40,55],[40,5],[75,10],[75,50]]'
        echo "[{\"image\": \"$composed.tif\", $corners}]" > corners.json
        vextract $decomposed.tif --scene scene.json --camera canon-5d-mark-ii \
            --illuminant D65 --regions corners.json
        "#,
    );
    assert_halves(&run, 1e-3, "regions");
    let run = sh(
        &folder,
        "vextract $decomposed.tif $decomposed.tif --scene scene.json --camera canon-5d-mark-ii \
            --illuminant D65 --regions corners.json --resume out.ndjson
        sed -i 's/\"id\":\"$decomposed\"/\"id\":\"$composed\"/' out.ndjson
        vextract $decomposed.tif $decomposed.tif --scene scene.json --camera canon-5d-mark-ii \
            --illuminant D65 --regions corners.json --resume out.ndjson"
            .replace("$decomposed", "cafe\u{301}")
            .replace("$composed", "caf\u{e9}")
            .as_str(),
    );
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
}

/// A camera that EXIF says is not the one that was named.
#[test]
fn another_camera_in_exif_is_said_and_a_doubt() {
    let folder = Workdir::new();
    let taken = folder.sh(
        "vkernel --angle-deg 45 | vforward -q --reflectance cc24:orange --exposure 0.8 --photon-noise 0.007 \\
        --render fold.tif --render-size 320x240 | tail -n 1 > corners.json",
    );
    assert_eq!(taken.status, 0, "{taken:?}");
    let of = |make: &str, model: &str, camera: &str| {
        let line = format!(
            "oiiotool fold.tif --attrib Make '{make}' --attrib Model '{model}' -d uint16 -o a.tif
            vkernel --angle-deg 45 | vextract a.tif {camera} --illuminant D65 \
                --regions corners.json > sample.ndjson"
        );
        let run = sh(&folder, &line);
        assert_eq!(run.status, 0, "{run:?}");
        let estimate = sample(&folder.sh("vestimate sample.ndjson --quiet"));
        (run.stderr, estimate["estimate"]["verdict"]["because"].to_string())
    };
    let (said, because) = of("Canon", "Canon EOS R5", "--camera nikon-d850 --quiet");
    assert_eq!(
        said,
        "vextract: warning: a.tif: its EXIF names Canon EOS R5, but the sensitivities used are those \
         of nikon-d850: expect a wrong spectrum; give --camera canon-eos-r5, or leave --camera out\n"
    );
    assert!(because.contains("EXIF says that Canon EOS R5 took the picture, not nikon-d850"), "{because}");
    for (model, camera) in [
        ("Canon EOS R5", "--camera canon-eos-r5"),
        ("Canon EOS 5D Mark II", "--camera canon-eos-5d-mark-ii"),
        ("Canon EOS 5D Mark II", "--camera canon-5d-mark-ii"),
        ("Canon EOS R5", "--camera mine.csv"),
        ("", "--camera nikon-d850"),
    ] {
        folder.sh("printf 'nm,R,G,B\n380,0,0.1,1\n550,0.3,0.9,0.2\n720,1,0,0\n' > mine.csv");
        let (said, because) = of("Canon", model, camera);
        assert!(
            said.is_empty() && !because.contains("took the picture"),
            "{model} {camera}: {said} {because}"
        );
    }
    let (said, _) = of("Canon", "Canon EOS 5D Mark II", "");
    assert_eq!(
        said,
        "vextract: Canon EOS 5D Mark II: using the sensitivities canon-5d-mark-ii; \
         for the other measurement give --camera canon-eos-5d-mark-ii\n"
    );
}

/// As programs of Windows write lists, too.
#[test]
fn lists_of_photographs_are_in_utf_8_or_utf_16() {
    let folder = Workdir::new();
    let run = sh(
        &folder,
        r"halves -d uint16 -o a.tif; cp a.tif ä.tif
        printf 'a.tif\nä.tif\n' > plain.txt
        printf '\357\273\277a.tif\r\n\r\nä.tif\r\n' > marked.txt
        iconv -f UTF-8 -t UTF-16 plain.txt > wide.txt
        for list in plain.txt marked.txt wide.txt; do
            of_canon --files-from $list | grep -c facet_rgb
        done
        of_canon --files-from - < wide.txt | grep -c facet_rgb",
    );
    assert_eq!((run.status, run.stdout.as_str()), (0, "2\n2\n2\n2\n"), "{}", run.stderr);
}

/// No fix, wiped, or blank: like a picture that does not say where or when it was taken.
#[test]
fn places_and_times_that_are_none() {
    let folder = Workdir::new();
    let place = |latitude: &str, south: &str, longitude: &str, west: &str| {
        format!(
            "--attrib:type=float[3] GPS:Latitude {latitude} --attrib GPS:LatitudeRef '{south}' \
             --attrib:type=float[3] GPS:Longitude {longitude} --attrib GPS:LongitudeRef '{west}'"
        )
    };
    let noon = "--attrib GPS:DateStamp 2026:06:21 --attrib:type=float[3] GPS:TimeStamp 10,0,0";
    let clock = |time: &str, offset: &str| {
        format!("--attrib Exif:DateTimeOriginal '{time}' --attrib Exif:OffsetTimeOriginal '{offset}'")
    };
    let munich = place("48,8,24", "N", "11,34,48", "E");
    for (attributes, light) in [
        (format!("{munich} {noon}"), "sun:48.14,11.58,2026-06-21T10:00:00Z"),
        (format!("{} {noon}", place("0,0,0", "N", "0,0,0", "E")), "D65"),
        (format!("{} {noon}", place("48,8,24", " ", "11,34,48", "E")), "D65"),
        (
            format!("{} {noon}", place("8,0,0", "South", "11,0,0", "West")),
            "sun:-8.00,-11.00,2026-06-21T10:00:00Z",
        ),
        (
            format!("{munich} {noon} {}", clock("0000:00:00 00:00:00", "+02:00")),
            "sun:48.14,11.58,2026-06-21T10:00:00Z",
        ),
        (
            format!("{munich} {noon} {}", clock("2026:06:21 09:00:00", "   :  ")),
            "sun:48.14,11.58,2026-06-21T10:00:00Z",
        ),
        (format!("{munich} {}", clock("2026:06:21 09:00:00", "   :  ")), "D65"),
    ] {
        let run = sh(
            &folder,
            &format!(
                "halves {attributes} -d uint8 -o a.jpg; extract a.jpg --camera canon-5d-mark-ii | head -n 1"
            ),
        );
        assert_eq!(sample(&run)["illuminants"][0]["name"], light, "{attributes}: {}", run.stderr);
    }
    if is_there(FILES) {
        let line = format!("extract {FILES}/place_all_zeros.tif | head -n 1");
        let run = sh(&folder, &line);
        assert!(
            run.stderr.contains("daylight assumed: the photograph does not say where it was taken"),
            "{}",
            run.stderr
        );
    }
}
