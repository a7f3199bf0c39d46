//! Mean power near the wavelength of a waveband, for lights that were measured in smaller steps: a lamp's
//! lines would be missed, or stand for all of a waveband, if samples were picked.

/// The mean of samples joined by straight lines, weighted by a triangle that falls to zero at the wavelengths
/// before and after that of the waveband: the power that counts if sensitivity and reflectance change
/// linearly between wavebands. All power counts once.
///
/// `None` if no two samples within the triangle are closer to each other than wavebands, or samples begin or
/// end within it.
pub(super) fn mean(wavelengths_nm: &[f64], values: &[f64], [before, at, after]: [f64; 3]) -> Option<f64> {
    let first = wavelengths_nm.partition_point(|nm| *nm <= before);
    let end = wavelengths_nm.partition_point(|nm| *nm < after);
    if first == 0 || end == wavelengths_nm.len() {
        return None;
    }
    // steps of decimal numbers are alike but for rounding
    let step_nm = (1.0 - 1e-9) * (at - before).min(after - at);
    if !wavelengths_nm[first - 1..=end].windows(2).any(|pair| pair[1] - pair[0] < step_nm) {
        return None;
    }
    let power = |nm: f64| {
        let right = wavelengths_nm.partition_point(|own| *own < nm).max(1);
        let [a, b] = [right - 1, right].map(|n| (wavelengths_nm[n], values[n]));
        a.1 + (b.1 - a.1) * (nm - a.0) / (b.0 - a.0)
    };
    let height = |nm: f64| if nm < at { (nm - before) / (at - before) } else { (after - nm) / (after - at) };
    let within = &wavelengths_nm[first..end];
    let middle = within.partition_point(|nm| *nm < at);
    let ends = [&[before], &within[..middle], &[at], &within[middle..], &[after]].concat();
    // exact for the product of two linear functions
    let integral = |pair: &[f64]| {
        let [(a, rise), (b, fall)] = [pair[0], pair[1]].map(|nm| (power(nm), height(nm)));
        (pair[1] - pair[0]) / 6.0 * (2.0 * a * rise + a * fall + b * rise + 2.0 * b * fall)
    };
    Some(ends.windows(2).map(integral).sum::<f64>() / (0.5 * (after - before)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn even(step_nm: f64) -> Vec<f64> {
        (0..=(200.0 / step_nm) as usize).map(|n| 400.0 + step_nm * n as f64).collect()
    }

    #[test]
    fn what_is_not_finer_has_no_mean() {
        let of = |step_nm: f64, ends: [f64; 3]| {
            let nm = even(step_nm);
            mean(&nm, &vec![1.0; nm.len()], ends)
        };
        assert!(of(10.0, [445.0, 450.0, 455.0]).is_none(), "coarser");
        assert!(of(0.1, [449.9, 450.0, 450.1]).is_none(), "alike");
        assert!(of(1.0, [395.0, 400.0, 405.0]).is_none(), "beyond the samples");
        assert!((of(1.0, [445.0, 450.0, 455.0]).unwrap() - 1.0).abs() < 1e-12);
    }

    proptest! {
        /// Wherever the lines of a lamp are: the trapezoid rule over wavebands gives its power.
        #[test]
        fn a_line_counts_once(steps_nm in prop::collection::vec(0.1_f64..4.9, 60), line in 20_usize..40) {
            let next = |nm: &mut f64, step_nm: &f64| {
                *nm += step_nm;
                Some(*nm)
            };
            let nm: Vec<f64> = steps_nm.iter().scan(300.0, next).collect();
            let values: Vec<f64> = (0..60).map(|n| f64::from(n == line)).collect();
            let power: f64 = 0.5 * (nm[line + 1] - nm[line - 1]);
            let bands = (0..40).map(|n| 290.0 + 5.0 * f64::from(n));
            let means = bands.filter_map(|at| mean(&nm, &values, [at - 5.0, at, at + 5.0]));
            prop_assert!((5.0 * means.sum::<f64>() - power).abs() < 1e-9 * power);
        }

        #[test]
        fn straight_lines_stay_as_they_are(
            at in 410.0_f64..590.0,
            slope in -1.0_f64..1.0,
            step_nm in 0.5_f64..4.9,
        ) {
            let nm = even(step_nm);
            let line = |nm: f64| 2.0 + slope * (nm - 450.0) / 100.0;
            let values: Vec<f64> = nm.iter().copied().map(line).collect();
            let got = mean(&nm, &values, [at - 5.0, at, at + 5.0]).unwrap();
            prop_assert!((got - line(at)).abs() < 1e-12);
        }
    }
}
