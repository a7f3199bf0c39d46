//! The simulated photograph.

use nalgebra::DMatrix;
use vfold::camera::CameraResponse;
use vfold::colorimetry::{Colorimeter, Observer};
use vfold::forward::render::{FoldView, Picture};
use vfold::forward::{FacetModel, Lighting};
use vfold::scene::{FoldSetting, Setting, SurfaceSetting};
use vfold::stream::Corners;
use vfold::surfaces::ShapeView;
use vfold::{Error, Result};

use super::setup::Setup;
use super::subject::{Sheet, Subject};

impl Setup<'_> {
    /// Takes the photograph of the first sheet requested by `--render`; returns the positions of its panels.
    pub fn photograph(&self, subject: &Subject) -> Result<Vec<(usize, Corners)>> {
        let (Some(path), Subject::Sheets { sheets, .. }) = (&self.args.render.render, subject) else {
            return Ok(Vec::new());
        };
        let for_screen = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        let sheet = &sheets[0];
        let (mut picture, seen) = match &self.setting {
            Setting::Fold(fold) => self.fold_picture(fold, for_screen, sheet)?,
            Setting::Surface(surface) => self.shape_picture(surface, for_screen, sheet)?,
        };
        self.noise.add(picture.pixels_mut(), self.args.seed, u64::MAX);
        if for_screen {
            picture.save_for_screen(path)?;
        } else {
            picture.save(path)?;
        }
        Ok(seen)
    }

    fn fold_picture(
        &self,
        fold: &FoldSetting,
        for_screen: bool,
        sheet: &Sheet,
    ) -> Result<(Picture, Vec<(usize, Corners)>)> {
        let eye = self.eye()?;
        let render = &self.args.render;
        let view = FoldView::new(&fold.fold, &render.viewpoint(), render.frame()?)?;
        let lighting = if for_screen {
            Lighting { light: fold.light, sun: eye.clone(), sky: eye }
        } else {
            fold.lighting()?
        };
        let model = fold.fine_model(view.grid(), &lighting)?;
        let light = match self.args.sheet.shape()? {
            None => self.light(&model, sheet)?,
            Some(_) if for_screen => {
                let problem = "a sheet that is not perfectly matte is rendered only as the camera sees it";
                return Err(Error::usage("--render", problem, "end the name in .exr or .tif"));
            }
            Some(shape) => {
                let folded = fold.folded_sheet(shape, view.eye(), Some(view.grid()))?;
                let albedo = folded.albedo(&sheet.spectrum.reflectance)?;
                self.args.exposure * (self.bounces.facet_rgb(&model, &albedo).0 + folded.beyond(&albedo))
            }
        };
        Ok((view.take(&light), view.corners()))
    }

    fn shape_picture(
        &self,
        surface: &SurfaceSetting,
        for_screen: bool,
        sheet: &Sheet,
    ) -> Result<(Picture, Vec<(usize, Corners)>)> {
        let eye = self.eye()?;
        let (render, sources) = (&self.args.render, surface.scene.sources()?);
        let view = ShapeView::new(&surface.scene.shape()?, &sources, &render.viewpoint(), render.frame()?)?;
        let light = if for_screen {
            let model = surface.model_seen_by(&eye)?;
            self.light(&model, sheet)?
        } else {
            self.light(&self.model, sheet)?
        };
        Ok((view.take(&light), view.corners()))
    }

    fn light(&self, model: &FacetModel, sheet: &Sheet) -> Result<DMatrix<f64>> {
        Ok(self.args.exposure * self.matt_rgb(model, sheet)?.0)
    }

    /// The response of an eye adapted to the light.
    fn eye(&self) -> Result<CameraResponse> {
        let optics = &self.args.optics;
        let illuminant = optics.one_illuminant("name one with --render: a photograph has one light")?;
        let illuminant = self.args.common.illuminant(illuminant)?;
        let eye = Colorimeter::new(&optics.wavelengths_nm, &illuminant, Observer::Cie1931_2deg)?;
        Ok(CameraResponse::from_weights(eye.screen_weights()))
    }
}
