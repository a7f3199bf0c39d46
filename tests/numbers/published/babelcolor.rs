//! BabelColor (D. Pascale), *ColorChecker data*, mean of 30 charts: xyY under D50 for the 2° observer, as
//! colour-science 0.4.7 transcribes them (`colour.CCS_COLOURCHECKERS["BabelColor Average"]`), beside what
//! their spectra look like here.

use vfold::colorimetry::{Colorimeter, Observer};
use vfold::spectrum::{Outside, WavelengthGrid, illuminant, reflectances};

use super::{assert_near, chromaticity};

#[rustfmt::skip]
const XYY: [[f64; 3]; 24] = [
    [0.4325, 0.3788, 0.1034], [0.4191, 0.3748, 0.3525], [0.2761, 0.3004, 0.1847], [0.3700, 0.4501, 0.1335],
    [0.3020, 0.2877, 0.2324], [0.2856, 0.3910, 0.4174], [0.5291, 0.4075, 0.3117], [0.2339, 0.2155, 0.1140],
    [0.5008, 0.3293, 0.1979], [0.3326, 0.2556, 0.0644], [0.3989, 0.4998, 0.4435], [0.4962, 0.4428, 0.4358],
    [0.2040, 0.1696, 0.0579], [0.3270, 0.5033, 0.2307], [0.5709, 0.3298, 0.1268], [0.4694, 0.4732, 0.6081],
    [0.4177, 0.2704, 0.2007], [0.2151, 0.3037, 0.1903], [0.3488, 0.3628, 0.9129], [0.3451, 0.3596, 0.5885],
    [0.3446, 0.3590, 0.3595], [0.3438, 0.3589, 0.1912], [0.3423, 0.3576, 0.0893], [0.3439, 0.3565, 0.0320],
];

/// The spectra have three decimals, ends at 730 nm and steps of 10 nm, the colours four decimals.
#[test]
fn patches_have_the_colours_that_go_with_their_spectra() {
    let patches = reflectances("cc24-babelcolor").unwrap();
    assert_eq!(patches.len(), XYY.len());
    let grid = WavelengthGrid::uniform(380.0, 730.0, 5.0).unwrap();
    let d50 = Colorimeter::new(&grid, &illuminant("D50").unwrap(), Observer::Cie1931_2deg).unwrap();
    for (patch, want) in patches.iter().zip(XYY) {
        let xyz = d50.xyz(&patch.on(&grid, Outside::Refuse).unwrap());
        let [x, y] = chromaticity(xyz);
        assert_near(&[x, y, xyz[1] / 100.0], &want, 1e-3, patch.name());
    }
}
