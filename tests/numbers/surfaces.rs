//! Laws that any surface, light and reflectance obey, on kernels of no particular shape: any numbers with
//! reciprocity and row sums below 1 are one. The dense solution of eq. (15) checks poles and residues.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use vfold::camera::CameraResponse;
use vfold::forward::FacetModel;
use vfold::paper::nonuniform;
use vfold::surfaces::{DenseExchange, Exchange, ReducedExchange, SurfaceResponse};

/// Patches that exchange light, two of them lit.
#[derive(Clone, Debug)]
struct Surface {
    /// K of eq. (10).
    kernel: DMatrix<f64>,
    areas: Vec<f64>,
    lights: [DVector<f64>; 2],
}

impl Surface {
    /// `shares` of light between every two patches, the largest row sum of K being `most`.
    fn new(shares: &[f64], areas: Vec<f64>, lights: [Vec<f64>; 2], most: f64) -> Self {
        let count = areas.len();
        let flux = |i: usize, j: usize| if i == j { 0.0 } else { shares[i.min(j) * count + i.max(j)] };
        let kernel = DMatrix::from_fn(count, count, |i, j| flux(i, j) / areas[i]);
        let largest = kernel.row_iter().map(|row| row.sum()).fold(f64::MIN_POSITIVE, f64::max);
        Self { kernel: kernel * (most / largest), areas, lights: lights.map(DVector::from_vec) }
    }

    /// Every patch a facet.
    fn exchange(&self) -> DenseExchange {
        DenseExchange::new(&self.kernel, &self.areas, (0..self.areas.len()).collect())
    }

    fn response(&self, light: &DVector<f64>) -> SurfaceResponse {
        SurfaceResponse::solve(&self.exchange(), light.as_slice(), 1e-13).unwrap().0
    }

    /// Irradiance by solving eq. (15) as it stands, with one reflectance per patch.
    fn dense(&self, light: &DVector<f64>, reflectance: &DVector<f64>) -> DVector<f64> {
        let count = self.areas.len();
        let system = DMatrix::identity(count, count) - &self.kernel * DMatrix::from_diagonal(reflectance);
        system.lu().solve(light).unwrap()
    }
}

fn irradiance(response: &SurfaceResponse, r: f64) -> DVector<f64> {
    DVector::from_fn(response.facets(), |facet, _| response.irradiance(facet, r))
}

/// Some patches see nothing of each other, some are not lit.
fn surfaces() -> impl Strategy<Value = Surface> {
    let sparse = || prop_oneof![1 => Just(0.0), 3 => 0.01..1.0];
    (2_usize..12).prop_flat_map(move |count| {
        let numbers = |count| prop::collection::vec(sparse(), count);
        let areas = prop::collection::vec(0.1..10.0, count);
        (numbers(count * count), areas, [numbers(count), numbers(count)], 0.1..0.99)
            .prop_filter("dark", |(_, _, lights, _)| {
                lights.iter().all(|light| light.iter().any(|e| *e > 0.0))
            })
            .prop_map(|(shares, areas, lights, most)| Surface::new(&shares, areas, lights, most))
    })
}

fn largest_difference(a: &DVector<f64>, b: &DVector<f64>) -> f64 {
    (a - b).amax() / b.amax()
}

proptest! {
    #[test]
    fn poles_and_residues_solve_eq_15(surface in surfaces(), r in 0.0..=1.0) {
        let light = &surface.lights[0];
        let ours = irradiance(&surface.response(light), r);
        let dense = surface.dense(light, &DVector::from_element(light.len(), r));
        prop_assert!(largest_difference(&ours, &dense) < 1e-10, "{ours} {dense}");
    }

    /// The light that leaves the surface or is lost in it is the light that falls on it.
    #[test]
    fn energy_is_kept(surface in surfaces(), r in 0.0..=1.0) {
        let light = &surface.lights[0];
        let all = irradiance(&surface.response(light), r);
        let power = |e: &DVector<f64>| e.iter().zip(&surface.areas).map(|(e, area)| e * area).sum::<f64>();
        let open = DVector::from_fn(light.len(), |i, _| 1.0 - surface.kernel.row(i).sum());
        let (lost, left) = (power(&((1.0 - r) * &all)), power(&(r * all.component_mul(&open))));
        prop_assert!((lost + left - power(light)).abs() < 1e-9 * power(light));
    }

    #[test]
    fn lights_superpose(surface in surfaces(), r in 0.0..=1.0, amount in 0.1..10.0) {
        let [sun, lamp] = &surface.lights;
        let both = irradiance(&surface.response(&(sun + amount * lamp)), r);
        let apart = irradiance(&surface.response(sun), r) + amount * irradiance(&surface.response(lamp), r);
        prop_assert!(largest_difference(&apart, &both) < 1e-10);
    }

    /// Facets are means over their patches, by area.
    #[test]
    fn facets_average_their_patches(surface in surfaces(), r in 0.0..=1.0) {
        let facet_of: Vec<usize> = (0..surface.areas.len()).map(|patch| patch / 2).collect();
        let exchange = DenseExchange::new(&surface.kernel, &surface.areas, facet_of);
        let light = &surface.lights[0];
        let (response, _) = SurfaceResponse::solve(&exchange, light.as_slice(), 1e-13).unwrap();
        let dense = surface.dense(light, &DVector::from_element(light.len(), r));
        let patches: Vec<usize> = (0..2.min(dense.len())).collect();
        let area: f64 = patches.iter().map(|patch| surface.areas[*patch]).sum();
        let mean: f64 = patches.iter().map(|patch| surface.areas[*patch] * dense[*patch]).sum::<f64>() / area;
        prop_assert_eq!(response.facets(), exchange.facets());
        prop_assert!((response.irradiance(0, r) - mean).abs() < 1e-10 * dense.amax());
    }
}

#[test]
fn without_light_there_is_no_response() {
    let exchange = DenseExchange::new(&DMatrix::zeros(1, 1), &[1.0], vec![0]);
    let error = SurfaceResponse::solve(&exchange, &[0.0], 1e-6).unwrap_err();
    assert!(error.to_string().contains("no light falls on the surface"));
}

/// A closed surface of r = 1 would gather light for ever.
#[test]
fn a_closed_surface_is_refused() {
    let kernel = nalgebra::dmatrix![0.0, 1.0; 1.0, 0.0];
    let exchange = DenseExchange::new(&kernel, &[1.0, 1.0], vec![0, 1]);
    let error = SurfaceResponse::solve(&exchange, &[1.0, 1.0], 1e-6).unwrap_err();
    assert!(error.to_string().contains("open it"));
}

/// One channel that sees each of some wavebands alike.
fn eye(bands: usize) -> CameraResponse {
    CameraResponse::from_weights(vec![vec![1.0 / bands as f64; bands]])
}

proptest! {
    /// Two lights of different colour on a surface of one reflectance.
    #[test]
    fn the_facet_model_adds_its_lights(surface in surfaces(), r in prop::array::uniform2(0.0..=1.0)) {
        let cameras = [vec![vec![0.7, 0.3]], vec![vec![0.2, 0.9]]].map(CameraResponse::from_weights);
        let lit = surface.lights.iter().map(|light| surface.response(light));
        let model = FacetModel::of_surface(&lit.zip(cameras.clone()).collect::<Vec<_>>());
        let mut dense = DVector::zeros(surface.areas.len());
        for (light, camera) in surface.lights.iter().zip(&cameras) {
            for (band, r) in r.iter().enumerate() {
                let all = surface.dense(light, &DVector::from_element(light.len(), *r));
                dense += camera.channel(0)[band] * *r * all;
            }
        }
        let ours = model.facet_rgb(&r).column(0).into_owned();
        prop_assert!((ours - &dense).amax() < 1e-10 * dense.amax().max(1e-6));
    }

    /// One reflectance per facet.
    #[test]
    fn facets_of_many_reflectances_obey_eq_24(
        surface in surfaces(),
        all in prop::collection::vec(prop_oneof![1 => Just(0.0), 9 => 0.0..=1.0], 12),
    ) {
        let r = DVector::from_column_slice(&all[..surface.areas.len()]);
        let light = &surface.lights[0];
        let lights = [(light.as_slice().to_vec(), eye(1))];
        let reflectance = DMatrix::from_column_slice(r.len(), 1, r.as_slice());
        let ours = nonuniform::surface_rgb(&surface.exchange(), &lights, &reflectance).unwrap();
        let dense = r.component_mul(&surface.dense(light, &r));
        prop_assert!((ours.column(0) - &dense).amax() < 1e-10 * dense.amax().max(1e-6));
    }

    /// Parts of known reflectance beside an unknown one, by the dense solution of every waveband; derivatives
    /// by differences.
    #[test]
    fn known_parts_drop_out(
        surface in surfaces(),
        known in prop::array::uniform4(0.0..=1.0),
        sheet in prop::array::uniform2(0.01..=0.99),
    ) {
        let count = surface.areas.len();
        let part_of: Vec<usize> = (0..count).map(|facet| facet % 3).collect();
        let lights = surface.lights.clone().map(|light| light.as_slice().to_vec());
        let reduced = ReducedExchange::new(&surface.exchange(), &part_of, &lights, 1e-12).unwrap();
        let parts = [Some(known[..2].to_vec()), None, Some(known[2..].to_vec())];
        let model = FacetModel::with_known(&reduced, &parts, &[eye(2), eye(2)]).unwrap();
        let mut dense = DVector::zeros(count);
        for band in 0..2 {
            let of = |facet: usize| parts[part_of[facet]].as_ref().map_or(sheet[band], |r| r[band]);
            let r = DVector::from_fn(count, |facet, _| of(facet));
            let all = surface.lights.iter().map(|light| surface.dense(light, &r)).sum::<DVector<f64>>();
            dense += 0.5 * r.component_mul(&all);
        }
        let ours = model.facet_rgb(&sheet).column(0).into_owned();
        prop_assert!((&ours - &dense).amax() < 1e-9 * dense.amax().max(1e-6), "{ours} {dense}");
        let [terms, slopes, curvatures] = model.derivatives_of(&sheet);
        let at = |change: f64| model.terms_of(&[sheet[0] + change, sheet[1] + change]);
        let step = 1e-5;
        let (below, above) = (at(-step), at(step));
        prop_assert!(((&above - &below) / (2.0 * step) - slopes).amax() < 1e-5 * terms.amax());
        prop_assert!(((above + below - 2.0 * &terms) / (step * step) - curvatures).amax() < 1e-3);
    }
}
