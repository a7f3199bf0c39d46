//! The model of a photograph of a real sheet.

use nalgebra::DVector;
use vfold::estimate::emission::{Backing, Emission};
use vfold::estimate::measured::Measured;
use vfold::estimate::photograph::day::Day;
use vfold::estimate::photograph::error::ModelError;
use vfold::estimate::photograph::eye::Eye;
use vfold::estimate::photograph::hypotheses::{Hypothesis, Mistake, hypotheses_without_bounces};
use vfold::estimate::photograph::model::PhotographModel;
use vfold::estimate::photograph::sheet_models::{SheetModel, SheetModels};
use vfold::estimate::photograph::{Parts, StatedScene};
use vfold::estimate::prior::Prior;
use vfold::scene::{FoldSetting, PhotographedFold, Picture};
use vfold::solve::posterior::Model;
use vfold::stream::{Reader, Record};

/// Of every number: what its column leaves out as not depending on it, difference quotients of all residuals
/// know.
#[test]
fn derivatives_are_those_of_the_residuals() {
    let mut reader = Reader::open("tests/corpus/streams/photograph.ndjson").unwrap();
    let records: Vec<Record> = std::iter::from_fn(|| reader.read().unwrap()).collect();
    let [Record::Scene(scene), Record::Sample(sample)] = &records[..] else { panic!("a scene and a sample") };
    let setting = FoldSetting::of(scene).unwrap();
    let [rgb, sd] = [sample.facet_rgb().unwrap(), sample.facet_sd().unwrap().unwrap()];
    let fold = PhotographedFold::of(&setting);
    let measured = Measured { rgb: &rgb, sd: &sd };
    let parts = fold.parts(&Picture::of(sample, &measured, None).unwrap()).unwrap().unwrap();
    assert!(parts.stated.daylight.is_some(), "sky and ground shine, too");
    // what is not known of curves of so few samples
    let curve = |channel: usize| parts.eye.sensitivities.column(channel).into_owned();
    let errors = vec![(0, 0.05 * curve(0)), (2, 0.05 * curve(1))];
    let eye = Eye { errors, ..parts.eye.clone() };
    for by_chart in [false, true] {
        let stated = StatedScene { by_chart, ..parts.stated };
        let parts = Parts { stated, eye: eye.clone(), ..parts.clone() };
        check_derivatives(parts, scene.grid().unwrap().wavelengths_nm());
    }
}

fn check_derivatives(parts: Parts, wavelengths_nm: &[f64]) {
    let parts = [parts];
    let prior = Prior::built_in(wavelengths_nm).unwrap();
    let kinds = SheetModels::of(&parts).remove(0);
    let whitening = ModelError::of(parts[0].stated.priors, Day::Clear, 1.0)
        .whitening(&parts[0].places, &parts[0].values, &parts[0].sd)
        .unwrap();
    let ideal =
        [None, Some(Mistake::Angle), Some(Mistake::Exposure), Some(Mistake::Sky)].map(Hypothesis::ideal);
    let all =
        SheetModel::ALL.map(Hypothesis::usual).into_iter().chain(ideal).chain(hypotheses_without_bounces());
    // a sheet that emits nothing, then a thin one and a brightened one
    let emissions = Emission::all(wavelengths_nm, parts[0].eye.sun.as_slice(), Backing::Unknown);
    let emitting = emissions[1..3]
        .iter()
        .flat_map(|one| SheetModel::ALL.map(Hypothesis::usual).into_iter().map(move |of| (of, Some(one))));
    for (hypothesis, emission) in all.map(|one| (one, None)).chain(emitting) {
        let of = (hypothesis, emission);
        let model = PhotographModel::new(&parts[0], &kinds, of, prior.broad(), &whitening);
        // away from where all is as it is told
        let w = DVector::from_fn(model.unknowns(), |n, _| 0.3 * (n as f64 + 1.0).sin());
        let jacobian = model.linearise(&w).jacobian;
        let [scene, ..] = model.layout();
        for n in 0..model.unknowns() {
            let step = 1e-3;
            let [before, after] = [-step, step].map(|step| {
                let mut beside = w.clone();
                beside[n] += step;
                model.residuals(&beside)
            });
            let expected = (before - after) / (2.0 * step);
            let name = n.checked_sub(scene).and_then(|n| model.numbers.get(n)).map(|one| one.unknown);
            let off = (jacobian.column(n) - &expected).norm();
            assert!(
                off < 2e-3 * (1.0 + expected.norm()),
                "{hypothesis:?} {n} {name:?}: {off} of {}",
                expected.norm()
            );
        }
    }
}
