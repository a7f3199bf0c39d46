//! A photograph of any surface: facets in uniform colours, each in front of those it hides.

use nalgebra::{DMatrix, Vector3};

use super::Shape;
use super::sight::{Met, Sight};
use crate::error::Result;
use crate::forward::render::{Frame, Picture, Pinhole, Stand, Viewpoint};
use crate::geometry::{LightSource, Panel};
use crate::image::Point;

/// Distance of the camera in sizes of the shape,
const DISTANCE: f64 = 7.0;
/// and its offset to the right of the light and downwards, relative to the distance.
const ASIDE: [f64; 2] = [0.1, 0.12];
/// If the light is nearer to the y axis than this cosine, another axis is upright.
const ALONG_Y: f64 = 0.9;

/// A surface and its camera.
pub struct ShapeView {
    frame: Frame,
    camera: Pinhole,
    sight: Sight,
    /// Those that show their reflecting side.
    panels: Vec<(usize, Panel)>,
}

impl ShapeView {
    /// A view of a surface; unless `viewpoint` states otherwise, from the direction of its first light, with
    /// the y axis upright.
    ///
    /// # Errors
    /// As [`Viewpoint::camera`].
    pub fn new(shape: &Shape, sources: &[LightSource], viewpoint: &Viewpoint, frame: Frame) -> Result<Self> {
        let points: Vec<_> = shape.facets().flat_map(|facet| facet.corners().to_vec()).collect();
        let camera = viewpoint.camera(usual_stand(shape, sources, &points), &points, frame)?;
        let is_seen =
            |panel: &Panel| shape.facet(panel.facets.start).plane().height(&camera.position()) > 0.0;
        let panels = shape.panels().into_iter().filter(|(_, panel)| is_seen(panel)).collect();
        Ok(Self { frame, camera, sight: Sight::new(shape), panels })
    }

    /// The numbers of the panels that show their reflecting side, and their corners in the picture: crease
    /// end 0, crease end 1, outer end 1, outer end 0. Others may partly hide them.
    #[must_use]
    pub fn corners(&self) -> Vec<(usize, [Point; 4])> {
        let seen = |(k, panel): &(usize, Panel)| Some((*k, self.camera.project_all(panel.corners)?));
        self.panels.iter().filter_map(seen).collect()
    }

    /// Takes a picture of the light on the facets (facet by channel), with up to three channels, on a black
    /// background. Facets seen from behind are black.
    #[must_use]
    pub fn take(&self, light: &DMatrix<f64>) -> Picture {
        Picture::take(self.frame, &self.camera, |eye, sight| match self.sight.first(&eye, &sight) {
            Some(Met { facet, in_front: true, .. }) => {
                std::array::from_fn(|channel| light.get((facet, channel)).copied().unwrap_or(0.0))
            }
            _ => [0.0; 3],
        })
    }
}

/// From slightly beside the light; rolled by two degrees, so that no pixel row is parallel to an edge.
fn usual_stand(shape: &Shape, sources: &[LightSource], points: &[Vector3<f64>]) -> Stand {
    let extreme = |pick: fn(f64, f64) -> f64| {
        points.iter().copied().reduce(|a, b| a.zip_map(&b, pick)).unwrap_or_default()
    };
    let (low, high) = (extreme(f64::min), extreme(f64::max));
    let look_at = (low + high) / 2.0;
    let towards = towards_light(shape, sources, &look_at);
    let up = if towards.y.abs() < ALONG_Y {
        Vector3::new(0.035, 1.0, 0.0)
    } else {
        Vector3::new(0.035, 0.0, -1.0)
    };
    let right = up.cross(&towards).normalize();
    let direction = (towards + ASIDE[0] * right - ASIDE[1] * towards.cross(&right)).normalize();
    Stand { eye: look_at + DISTANCE * (high - low).norm() * direction, look_at, up }
}

/// Direction of the light; if there are only skies, the direction that most of the surface faces.
fn towards_light(shape: &Shape, sources: &[LightSource], middle: &Vector3<f64>) -> Vector3<f64> {
    let of_source = |source: &LightSource| match source {
        LightSource::Directional { towards, .. } => Some(*towards),
        LightSource::Point { at, .. } => (at - middle).try_normalize(0.0),
        LightSource::Area { corners, .. } => {
            (corners.iter().sum::<Vector3<f64>>() / 4.0 - middle).try_normalize(0.0)
        }
        LightSource::UniformSky { .. }
        | LightSource::OvercastSky { .. }
        | LightSource::StandardSky { .. }
        | LightSource::PerFacet => None,
    };
    let facing = || shape.facets().map(|facet| facet.area() * facet.normal()).sum::<Vector3<f64>>();
    sources.iter().find_map(of_source).or_else(|| facing().try_normalize(0.0)).unwrap_or_else(Vector3::z)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use crate::geometry::{FacetGrid, Fold, Vec3};
    use crate::surfaces::Accordion;

    /// Every pixel shows the facet that a search without tree or projection finds through its four corners,
    /// if it finds one.
    #[test]
    fn pixels_inside_a_facet_have_its_very_colour() {
        let valley = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 3, cols: 2 }).unwrap();
        let w = Accordion { valley, creases: 3, ridge_deg: 100.0, bow_deg: 0.0 }.shape().unwrap();
        let sun = LightSource::directional([0.0, 0.0, 1.0], 1.0).unwrap();
        let viewpoint = Viewpoint { eye: Some(Vec3::new(4.0, -3.0, 5.0)), ..Viewpoint::default() };
        let (width, height) = (90, 60);
        let view = ShapeView::new(&w, &[sun], &viewpoint, Frame::new(width, height).unwrap()).unwrap();
        let light = DMatrix::from_fn(w.len(), 3, |facet, channel| (1 + 3 * facet + channel) as f64 / 7.0);
        let mut picture = view.take(&light);
        let (mut exact, mut dark) = (0, 0);
        for (n, pixel) in picture.pixels_mut().chunks(3).enumerate() {
            let at = |k: usize| Point::new((n % width + k % 2) as f64, (n / width + k / 2) as f64);
            let met = [0, 1, 2, 3].map(|k| nearest(&w, &view.camera, at(k)));
            if met.iter().any(|other| *other != met[0]) {
                continue;
            }
            let Some((facet, in_front)) = met[0] else { continue };
            let expected = [0, 1, 2].map(|channel| if in_front { light[(facet, channel)] } else { 0.0 });
            assert!(
                pixel.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14),
                "{n}: {pixel:?} {expected:?}"
            );
            if in_front { exact += 1 } else { dark += 1 }
        }
        assert!(exact > 500 && dark > 100, "{exact} {dark}");
        let seen: Vec<usize> = view.corners().iter().map(|(panel, _)| *panel).collect();
        assert_eq!(seen, [0, 1, 2]); // the last shows its back
    }

    /// The first facet, from the planes and sides of all.
    fn nearest(shape: &Shape, camera: &Pinhole, at: Point) -> Option<(usize, bool)> {
        let (eye, sight) = (camera.position(), camera.line_of_sight(at));
        let met = shape.facets().enumerate().filter_map(|(n, facet)| {
            let distance = facet.normal().dot(&(facet.centroid() - eye)) / facet.normal().dot(&sight);
            let point = eye + distance * sight;
            let turns = facet.edges().map(|(a, b)| (b - a).cross(&(point - a)).dot(&facet.normal()));
            (distance > 0.0 && turns.into_iter().all(|turn| turn > 0.0)).then_some((
                distance,
                n,
                facet.normal().dot(&sight) < 0.0,
            ))
        });
        met.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, facet, in_front)| (facet, in_front))
    }
}
