//! The cross-section of a bent fold: two bowed panels and a rounded crease, as strips between points of the
//! plane across the crease.

use nalgebra::{Matrix2, Vector2};

use crate::geometry::Fold;

use super::BentFold;

/// Strip boundaries of a panel, as fractions of the depth beyond the rounding.
const EDGES: [f64; 8] = [0.0, 0.02, 0.06, 0.13, 0.25, 0.45, 0.7, 1.0];
/// Number of strips on either half of the rounding.
const ROUNDING: usize = 3;
/// Roundings and bows below this, in panel depths and radians, count as zero.
const NONE: f64 = 1e-9;
/// The rounding covers at most this fraction of a panel.
const ROUNDING_MAX: f64 = 0.9;

/// A strip of the sheet, seen along the crease: x across, z out of the opening.
#[derive(Clone, Copy, Debug)]
pub struct Strip {
    /// End towards the crease.
    pub near: Vector2<f64>,
    /// End towards the outer edge.
    pub far: Vector2<f64>,
    /// Unit normal on the lit side.
    pub normal: Vector2<f64>,
    /// Unit normals of the curve that it approximates, at both ends.
    pub bent: [Vector2<f64>; 2],
}

impl Strip {
    /// Depth, in the unit of its ends.
    pub fn depth(&self) -> f64 {
        (self.far - self.near).norm()
    }

    /// The point at fraction `share` from the near to the far end.
    pub fn at(&self, share: f64) -> Vector2<f64> {
        self.near + share * (self.far - self.near)
    }

    /// The unit normal of the curve there.
    pub fn bent_at(&self, share: f64) -> Vector2<f64> {
        self.bent[0].lerp(&self.bent[1], share).normalize()
    }
}

/// A panel's arc from the virtual crease, where the panels would meet without rounding, to its outer edge.
#[derive(Clone, Copy, Debug)]
struct Arc {
    chord: Vector2<f64>,
    normal: Vector2<f64>,
    depth: f64,
    /// Turn over the depth, radians: positive towards the light.
    turn: f64,
}

impl Arc {
    /// Length along the arc.
    fn length(&self) -> f64 {
        if self.turn.abs() < NONE {
            self.depth
        } else {
            self.depth * (self.turn / 2.0) / (self.turn / 2.0).sin()
        }
    }

    /// Point at fraction `share` of the length.
    fn at(&self, share: f64) -> Vector2<f64> {
        if self.turn.abs() < NONE {
            return share * self.depth * self.chord;
        }
        let (begin, here) = (-0.5 * self.turn, self.turn * (share - 0.5));
        let (along, up) = (here.sin() - begin.sin(), begin.cos() - here.cos());
        self.length() / self.turn * (along * self.chord + up * self.normal)
    }

    fn tangent(&self, share: f64) -> Vector2<f64> {
        let (sin, cos) = (self.turn * (share - 0.5)).sin_cos();
        cos * self.chord + sin * self.normal
    }

    fn normal(&self, share: f64) -> Vector2<f64> {
        let (sin, cos) = (self.turn * (share - 0.5)).sin_cos();
        cos * self.normal - sin * self.chord
    }
}

/// The circle inside the fold that touches both panels.
struct Rounding {
    radius: f64,
    centre: Vector2<f64>,
    /// Points of contact, as fractions of the arcs.
    touches: [f64; 2],
}

impl Rounding {
    /// The circle of `radius` tangent to both arcs, by Newton's method from the one tangent to their chords;
    /// `None` for a flat sheet.
    fn between(arcs: &[Arc; 2], radius: f64, half_angle: f64) -> Option<Self> {
        let mut touches = arcs.map(|arc| radius / half_angle.tan() / arc.depth);
        let centres = |touches: [f64; 2]| {
            [0, 1].map(|p: usize| arcs[p].at(touches[p]) + radius * arcs[p].normal(touches[p]))
        };
        for _ in 0..6 {
            let [from_0, from_1] = centres(touches);
            let speed = [0, 1]
                .map(|p: usize| (arcs[p].length() - radius * arcs[p].turn) * arcs[p].tangent(touches[p]));
            let step = Matrix2::from_columns(&[speed[0], -speed[1]]).try_inverse()? * (from_0 - from_1);
            touches = [0, 1].map(|p: usize| (touches[p] - step[p]).clamp(0.0, ROUNDING_MAX));
        }
        Some(Self { radius, centre: centres(touches)[0], touches })
    }

    /// Strips from the bottom to the point of contact with panel `p`.
    fn strips(&self, arc: &Arc, p: usize) -> Vec<Strip> {
        let end = arc.normal(self.touches[p]);
        let turn = end.x.atan2(end.y);
        let normal = |n: usize| {
            let (sin, cos) = (turn * n as f64 / ROUNDING as f64).sin_cos();
            Vector2::new(sin, cos)
        };
        let point = |n: usize| self.centre - self.radius * normal(n);
        (0..ROUNDING).map(|n| strip(p, [point(n), point(n + 1)], [normal(n), normal(n + 1)])).collect()
    }
}

/// Strips of panel 0 and panel 1, from the bottom of the crease outwards, in the unit of the fold.
pub fn strips(bent: &BentFold, fold: &Fold) -> [Vec<Strip>; 2] {
    let half = bent.angle_deg.to_radians() / 2.0;
    let arcs = [0, 1].map(|p: usize| {
        let (sin, cos) = half.sin_cos();
        let side = side(p);
        Arc {
            chord: Vector2::new(side * sin, cos),
            normal: Vector2::new(-side * cos, sin),
            depth: fold.depths()[p],
            turn: bent.bow_deg[p].to_radians(),
        }
    });
    let radius = bent.crease_radius * 0.5 * (fold.depths()[0] + fold.depths()[1]);
    let rounding = (radius > NONE).then(|| Rounding::between(&arcs, radius, half)).flatten();
    [0, 1].map(|p: usize| {
        let arc = &arcs[p];
        let begin = rounding.as_ref().map_or(0.0, |rounding| rounding.touches[p]);
        let share = |edge: f64| begin + (1.0 - begin) * edge;
        let mut strips = rounding.as_ref().map_or_else(Vec::new, |rounding| rounding.strips(arc, p));
        strips.extend(EDGES.windows(2).map(|pair| {
            let [near, far] = [share(pair[0]), share(pair[1])];
            strip(p, [arc.at(near), arc.at(far)], [arc.normal(near), arc.normal(far)])
        }));
        strips
    })
}

/// -1 for panel 0, which has negative x; 1 for panel 1.
fn side(p: usize) -> f64 {
    if p == 0 { -1.0 } else { 1.0 }
}

fn strip(p: usize, [near, far]: [Vector2<f64>; 2], bent: [Vector2<f64>; 2]) -> Strip {
    let along = (far - near).normalize();
    Strip { near, far, normal: side(p) * Vector2::new(-along.y, along.x), bent }
}
