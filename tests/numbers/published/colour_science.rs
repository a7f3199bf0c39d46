//! colour-science 0.4.7 judges estimates of all 1269 Munsell chips as vscore does: the same spectra, light
//! and observer, sums by NumPy.

use crate::common::Workdir;

const ESTIMATES: &str = "
vkernel --facets 1x1 | vforward --reflectance munsell --noise-sd 3e-3 | vestimate -o estimates.ndjson
vscore estimates.ndjson --metrics rmse,ciede2000,gfc,angle --colour --no-history -o D65-10.ndjson
vscore estimates.ndjson --metrics rmse,ciede2000,gfc,angle --colour --no-history --illuminant A \
    --observer 2 -o A-2.ndjson
";

const JUDGE: &str = r#"
import json, warnings
warnings.filterwarnings("ignore")
import colour, numpy as np

shape = colour.SpectralShape(400, 700, 5)
for light, observer in (
    ("D65", "CIE 1964 10 Degree Standard Observer"),
    ("A", "CIE 1931 2 Degree Standard Observer"),
):
    records = list(map(json.loads, open(f"{light}-{'10' if '10' in observer else '2'}.ndjson")))
    samples = [record for record in records if record["kind"] == "sample"]
    assert len(samples) == 1269
    power = colour.SDS_ILLUMINANTS[light].copy().align(shape).values
    weights = power[:, np.newaxis] * colour.MSDS_CMFS[observer].copy().align(shape).values
    weights[[0, -1]] /= 2
    white = weights.sum(axis=0)

    def spectra(of):
        return np.array([sample[of]["reflectance"] for sample in samples])

    def xyz(reflectances):
        return reflectances @ weights / white[1]

    def lab(reflectances):
        return colour.XYZ_to_Lab(xyz(reflectances), colour.XYZ_to_xy(white))

    def agree(name, theirs, tolerance):
        ours = np.array([
            sample["metrics"][name] if name in sample["metrics"] else sample["colour"][name]
            for sample in samples
        ])
        off = np.abs(ours - theirs).max()
        print(f"{light} {name}: off by {off:.1e} at most, mean {np.mean(theirs):.4f}")
        assert off < tolerance, name

    truth, estimate = spectra("truth"), spectra("estimate")
    cosine = (truth * estimate).sum(axis=1) / np.sqrt((truth**2).sum(axis=1) * (estimate**2).sum(axis=1))
    agree("rmse", np.sqrt(((truth - estimate) ** 2).mean(axis=1)), 1e-14)
    agree("gfc", cosine, 1e-14)
    agree("angle_deg", np.degrees(np.arccos(cosine)), 1e-9)
    agree("xyz", 100 * xyz(estimate), 1e-9)
    agree("lab", lab(estimate), 1e-9)
    agree("ciede2000", colour.delta_E(lab(truth), lab(estimate), method="CIE 2000"), 1e-9)
"#;

#[test]
fn all_munsell_chips_are_scored_alike() {
    let folder = Workdir::new();
    if !folder.can("python3 -c 'import colour'", "scores of the Munsell chips") {
        return;
    }
    let run = folder.sh(&format!("{ESTIMATES}cat > judge.py <<'END'{JUDGE}END\npython3 judge.py"));
    println!("{}", run.stdout);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{run:?}");
    assert_eq!(run.stdout.lines().count(), 12, "two lights, six scores");
}
