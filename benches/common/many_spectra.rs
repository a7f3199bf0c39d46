//! Spectra that no chart has, as many as wanted: greys from 0.02 to 0.98, whites, dyes and edges.

/// A table of them, a column each, from 400 to 700 nm by 5; of every 199, 49 are greys, 30 whites and 60
/// dyes.
pub fn many_spectra(count: usize) -> String {
    let share = |n: usize, step: f64| (n as f64 * step).fract();
    let step_at = |nm: f64, middle: f64, width: f64| 1.0 / (1.0 + ((middle - nm) / width).exp());
    let band = |nm: f64, middle: f64| (-0.5 * ((1e7 / nm - 1e7 / middle) / 1800.0_f64).powi(2)).exp();
    let [greys, whites, dyes] = [49, 30, 60].map(|of_199| count * of_199 / 199);
    let grey = |n: usize| 0.02 + 0.96 * n as f64 / (greys - 1) as f64;
    let white = |n: usize, nm: f64| {
        0.8 + 0.17 * share(n, 0.618) - 0.3 * share(n, 0.414) * (-(nm - 400.0) / 40.0).exp()
    };
    // Kubelka and Munk's
    let dye = |n: usize, nm: f64| {
        let absorbed = 10.0_f64.powf(2.5 * share(n, 0.618) - 1.3) * band(nm, 410.0 + 260.0 * share(n, 0.414))
            + 0.5 * share(n, 0.732) * band(nm, 410.0 + 260.0 * share(n, 0.236))
            + 0.01;
        1.0 + absorbed - (absorbed * absorbed + 2.0 * absorbed).sqrt()
    };
    let edge = |n: usize, nm: f64| {
        let step = step_at(nm, 430.0 + 240.0 * share(n, 0.618), 3.0 + 25.0 * share(n, 0.414));
        0.03 + (0.2 + 0.6 * share(n, 0.732)) * if n % 5 < 3 { step } else { 1.0 - step }
    };
    let at = |nm: f64| -> Vec<f64> {
        let (greys, whites) = ((0..greys).map(grey), (0..whites).map(|n| white(n, nm)));
        let (dyes, edges) = ((0..dyes).map(|n| dye(n, nm)), (0..count).map(|n| edge(n, nm)));
        greys.chain(whites).chain(dyes).chain(edges).take(count).collect()
    };
    let names = (0..count).map(|n| format!(",s{n}")).collect::<String>();
    let row = |nm: u32| {
        let values = at(f64::from(nm)).into_iter().map(|value| format!(",{value:.6}"));
        format!("{nm}{}\n", values.collect::<String>())
    };
    format!("nm{names}\n{}", (400..=700).step_by(5).map(row).collect::<String>())
}
