//! Every extreme that has bounds, a row each. What a row does not say is 45°, square panels of 10 x 10
//! facets, a Canon EOS 5D Mark II and D65.

/// One extreme and the bounds that hold there.
pub struct Row {
    /// What is extreme.
    pub what: &'static str,
    /// Flags of vkernel.
    pub scene: &'static str,
    /// Whether bounces are solved on undivided panels; else every facet is one flat patch.
    pub undivided: bool,
    /// Flags of vforward.
    pub seen: &'static str,
    /// Reflectance of the sheet whose facets are compared, then of the one that is estimated.
    pub sheets: [&'static str; 2],
    /// How far facets are off at most, as a share of the brightest.
    pub facets: f64,
    /// RMSE of the estimate, and the root mean square of its errors in units of their standard deviations;
    /// none where it must be refused.
    pub estimate: Option<[f64; 2]>,
}

/// Bright, so that light bounces often; then one of a class that the prior knows.
const SHEETS: [&str; 2] = ["0.9", "cc24:red"];
/// Bound on the errors of a sheet that the prior knows, in standard deviations.
const HONEST: f64 = 2.0;
/// Tools and NumPy solve the same equations.
const EXACT: f64 = 1e-9;

const fn fold(what: &'static str, scene: &'static str, rmse: f64) -> Row {
    let estimate = Some([rmse, HONEST]);
    Row { what, scene, undivided: false, seen: "", sheets: SHEETS, facets: EXACT, estimate }
}

const fn undivided(what: &'static str, scene: &'static str, facets: f64, rmse: f64) -> Row {
    Row { undivided: true, facets, ..fold(what, scene, rmse) }
}

const fn sheet(what: &'static str, reflectance: &'static str, estimate: Option<[f64; 2]>) -> Row {
    Row { sheets: [reflectance; 2], estimate, ..fold(what, "", 0.0) }
}

const fn seen(what: &'static str, seen: &'static str, rmse: f64, deviations: f64) -> Row {
    Row { seen, ..sheet(what, "cc24:red", Some([rmse, deviations])) }
}

#[rustfmt::skip]
pub const ROWS: [Row; 35] = [
    // one red sheet, of which its facets tell next to nothing: how far off, the kinds that are frequent
    // decide
    fold("angle 0.1°", "--angle-deg 0.1", 0.25),
    fold("angle 1°", "--angle-deg 1", 0.05),
    fold("angle 5°", "--angle-deg 5", 0.02),
    fold("angle 45°", "--angle-deg 45", 0.01),
    fold("angle 90°", "--angle-deg 90", 0.02),
    fold("angle 175°", "--angle-deg 175", 0.08),
    fold("angle 179°", "--angle-deg 179", 0.08),
    fold("angle 179.9°", "--angle-deg 179.9", 0.08),
    sheet("reflectance 0", "0", None),
    sheet("reflectance 1e-6", "1e-6", None),
    sheet("reflectance 0.5", "0.5", Some([0.04, HONEST])),
    sheet("reflectance 0.999", "0.999", Some([0.002, HONEST])),
    sheet("reflectance 1", "1", Some([0.0005, 4.0])),
    fold("facets 1x1", "--facets 1x1", 0.06),
    fold("facets 1x256", "--facets 1x256", 0.03),
    fold("facets 256x1", "--facets 256x1", 0.02),
    fold("facets 64x64", "--facets 64x64", 0.01),
    fold("facets 256x256", "--facets 256x256", 0.01),
    fold("panels 1000x1", "--panel 1000x1", 0.01),
    fold("panels 1x1000", "--panel 1x1000", 0.08),
    fold("panel 1 1000 times as deep as panel 0", "--panel1-depth 1000", 0.04),
    seen("light of one line", "--illuminant line.csv", 0.35, 3.5),
    seen("light of spikes, FL11", "--illuminant FL11", 0.01, HONEST),
    seen("light of 1e-200 with a gap", "--illuminant gap.csv", 0.02, HONEST),
    seen("camera of 1 channel", "--camera grey.csv", 0.03, HONEST),
    seen("camera of 3 channels", "--camera canon-5d-mark-ii", 0.01, HONEST),
    seen("camera of 12 channels", "--camera twelve.csv", 0.01, HONEST),
    seen("camera of 40 channels", "--camera forty.csv", 0.005, HONEST),
    undivided("undivided, 45°", "--angle-deg 45", 3e-5, 0.01),
    undivided("undivided, 90°", "--angle-deg 90", 1e-5, 0.01),
    undivided("undivided, 175°", "--angle-deg 175", 1e-5, 0.08),
    undivided("undivided, 179.9°", "--angle-deg 179.9", 1e-5, 0.08),
    undivided("undivided, 1000x1", "--panel 1000x1 --facets 10x1", 3e-4, 0.02),
    undivided("undivided, 1000x1, 5°", "--panel 1000x1 --facets 10x1 --angle-deg 5 --tolerance 1e-4",
        3e-4, 0.04),
    undivided("undivided, 1000x1, 1°", "--panel 1000x1 --facets 10x1 --angle-deg 1 --tolerance 1e-3",
        3e-4, 0.08),
];
