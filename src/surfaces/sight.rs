//! The first facet along a line of sight.

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use bvh::ray::Ray;

use super::Shape;
use super::polygon::{Polygon, edges};
use crate::geometry::{Panel, Vec3};

/// Lines that miss a facet by less than this, relative to the shape, hit it: there is no gap between facets.
const GAP: f64 = 1e-12;
/// Margin of boxes around their facets, relative to the shape: flat ones would be missed.
const MARGIN: f64 = 1e-9;
/// Places along each side of a facet that must be visible for the whole facet to count as visible.
const PLACES: usize = 8;
/// Distance of the outermost of them from the sides, in sides: an obstruction there does not hide the facet.
const EDGE: f64 = 0.01;

/// A shape prepared for lines of sight.
pub struct Sight {
    boxes: Vec<FacetBox>,
    tree: Bvh<f64, 3>,
    gap: f64,
}

/// A facet in the tree of boxes.
struct FacetBox {
    facet: usize,
    polygon: Polygon,
    bounds: Aabb<f64, 3>,
    node: usize,
}

/// A facet hit by a line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// Its number.
    pub facet: usize,
    /// Its distance, in lengths of the direction.
    pub distance: f64,
    /// Whether it is hit on its reflecting side.
    pub in_front: bool,
}

impl Sight {
    /// Prepares a shape for lines of sight.
    ///
    /// # Example
    /// ```
    /// use vfold::surfaces::{Sight, Shape};
    /// use vfold::geometry::Vec3;
    /// let vertices = vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    /// let (shape, _) = Shape::new(vertices, vec![vec![0, 1, 2, 3]], vec![])?;
    /// let met = Sight::new(&shape).first(&Vec3::new(1.0, 0.5, 3.0), &-Vec3::z()).unwrap();
    /// assert_eq!((met.facet, met.distance, met.in_front), (0, 3.0, true));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn new(shape: &Shape) -> Self {
        let size = shape.size();
        let facet_box = |(facet, polygon): (usize, &Polygon)| {
            let corners = polygon.corners().iter().map(|corner| (*corner).into());
            let bounds = corners.fold(Aabb::empty(), |bounds, corner| bounds.grow(&corner));
            let margin = Vec3::repeat(MARGIN * size);
            let bounds = Aabb::with_bounds(bounds.min - margin, bounds.max + margin);
            FacetBox { facet, polygon: polygon.clone(), bounds, node: 0 }
        };
        let mut boxes: Vec<FacetBox> = shape.facets().enumerate().map(facet_box).collect();
        let tree = Bvh::build(&mut boxes);
        Self { boxes, tree, gap: GAP * size }
    }

    /// The first facet from `eye` in a direction; of two coincident ones, such as both sides of a sheet, the
    /// one hit on its reflecting side.
    #[must_use]
    pub fn first(&self, eye: &Vec3, direction: &Vec3) -> Option<Met> {
        let ray = Ray::new((*eye).into(), *direction);
        let near = self.tree.traverse(&ray, &self.boxes);
        let met = near.into_iter().filter_map(|near| near.met(eye, direction, self.gap));
        met.min_by(|a, b| match (a.distance - b.distance).abs() <= self.gap {
            true => b.in_front.cmp(&a.in_front),
            false => a.distance.total_cmp(&b.distance),
        })
    }

    /// Whether an entire facet of a panel, between its rows and columns, is visible from `eye` without
    /// obstructions.
    #[must_use]
    pub fn sees_all(&self, eye: &Vec3, panel: &Panel, [u, v]: [[f64; 2]; 2]) -> bool {
        let [start, end, _, outer] = panel.corners;
        let inside = |k: usize| EDGE + (1.0 - 2.0 * EDGE) * k as f64 / (PLACES - 1) as f64;
        let place = |ends: [f64; 2], k: usize| ends[0] + (ends[1] - ends[0]) * inside(k);
        (0..PLACES * PLACES).all(|k| {
            let (u, v) = (place(u, k % PLACES), place(v, k / PLACES));
            let direction = start + u * (end - start) + v * (outer - start) - eye;
            let is_panels = |met: Met| met.in_front && panel.facets.contains(&met.facet);
            self.first(eye, &direction).is_some_and(is_panels)
        })
    }
}

impl FacetBox {
    fn met(&self, eye: &Vec3, direction: &Vec3, gap: f64) -> Option<Met> {
        let towards = direction.dot(&self.polygon.normal());
        let distance = -self.polygon.plane().height(eye) / towards;
        let point = eye + distance * direction;
        let is_inside = |(from, to): (Vec3, Vec3)| {
            let side = to - from;
            side.cross(&(point - from)).dot(&self.polygon.normal()) >= -gap * side.norm()
        };
        let met = distance > 0.0 && distance.is_finite() && edges(self.polygon.corners()).all(is_inside);
        met.then_some(Met { facet: self.facet, distance, in_front: towards < 0.0 })
    }
}

impl Bounded<f64, 3> for FacetBox {
    fn aabb(&self) -> Aabb<f64, 3> {
        self.bounds
    }
}

impl BHShape<f64, 3> for FacetBox {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{FacetGrid, Fold};
    use crate::surfaces::Accordion;
    use proptest::prelude::*;

    fn w() -> Shape {
        let valley = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 3, cols: 2 }).unwrap();
        Accordion { valley, creases: 3, ridge_deg: 100.0, bow_deg: 0.0 }.shape().unwrap()
    }

    proptest! {
        /// Against a search through all facets, without a tree.
        #[test]
        fn the_first_facet_is_the_nearest(
            eye in prop::array::uniform3(-3.0..3.0),
            at in prop::array::uniform3(-0.9..0.9),
        ) {
            let (shape, eye, at) = (w(), Vec3::from(eye), Vec3::from(at));
            let sight = Sight::new(&shape);
            let met = sight.boxes.iter().filter_map(|facet| facet.met(&eye, &(at - eye), 0.0));
            let nearest = met.min_by(|a, b| a.distance.total_cmp(&b.distance));
            prop_assert_eq!(
                sight.first(&eye, &(at - eye)).map(|met| met.distance),
                nearest.map(|met| met.distance)
            );
        }
    }

    /// From above nothing is hidden. From fourteen degrees to the right, the outer right panel, which leans
    /// by ten, shows its back and hides the valley; from low on the right only the top of the outer left
    /// panel is visible over it.
    #[test]
    fn a_panel_hides_what_is_behind_it() {
        let shape = w();
        let (sight, panels) = (Sight::new(&shape), shape.panels());
        let seen = |eye: Vec3, v: [f64; 2]| {
            [0, 1, 2, 3].map(|k: usize| sight.sees_all(&eye, &panels[&k], [[0.0, 1.0], v]))
        };
        assert_eq!(seen(Vec3::new(0.0, 0.0, 9.0), [0.0, 1.0]), [true; 4]);
        assert_eq!(seen(Vec3::new(3.0, 0.0, 9.0), [0.0, 1.0]), [true, true, false, false]);
        let low = Vec3::new(9.0, 0.0, 1.2);
        assert_eq!(seen(low, [0.9, 1.0]), [false; 4]);
        assert_eq!(seen(low, [0.97, 1.0]), [true, false, false, false]);
    }
}
