//! Light between the facets of surfaces that nobody would build.

use vfold::Result;
use vfold::geometry::{FacetGrid, Fold, LightSource};
use vfold::surfaces::kernel::SurfaceKernel;
use vfold::surfaces::kernel::lit::LitSurface;
use vfold::surfaces::kernel::patches::{Division, Patch, patches};
use vfold::surfaces::{Accordion, Exchange, Shape, SurfaceResponse};

use super::drawn::Drawn;
use super::{assert_finite, taken};

const TOLERANCE: f64 = 1e-2;
/// Pairs of more patches would take seconds.
const PATCHES_MAX: usize = 64;
/// Patches of which clusters exchange light.
const CLUSTERED: usize = 256;
/// Rows of the matrix that are looked at.
const ROWS: usize = 4;

/// Few patches, pair by pair: faces that cross, hide and touch each other.
pub fn surface(bytes: &[u8]) {
    let mut drawn = Drawn::from(bytes);
    let shape = if drawn.below(4) == 0 { accordion(&mut drawn) } else { heap(&mut drawn) };
    let Some(shape) = taken(shape) else { return };
    let two_sided = drawn.below(4) == 0;
    let Some(shape) = (if two_sided { taken(shape.with_backs()) } else { Some(shape) }) else { return };
    let patches = patches(&shape, Division { cells: 1 + drawn.below(3), graded: drawn.below(2) == 1 });
    if patches.len() <= PATCHES_MAX {
        assert_lawful(&shape, &patches, &mut drawn);
    }
}

/// Clusters that exchange light from afar give what their pairs do: in a pit whose walls see each other
/// whole.
pub fn clusters(bytes: &[u8]) {
    let mut drawn = Drawn::from(bytes);
    let Some(shape) = taken(pit(&mut drawn)) else { return };
    let cells = (1..).find(|cells| 3 * shape.len() * cells * cells >= CLUSTERED).unwrap();
    let patches = patches(&shape, Division { cells, graded: drawn.below(2) == 1 });
    let by = [SurfaceKernel::by_clusters, SurfaceKernel::by_pairs];
    let [clusters, pairs] = by.map(|by| taken(by(&shape, &patches, TOLERANCE)));
    let (Some(clusters), Some(pairs)) = (&clusters, &pairs) else {
        assert_eq!(clusters.is_some(), pairs.is_some());
        return;
    };
    assert_mutual(clusters, &mut drawn);
    assert_eq!(clusters.census(), pairs.census());
    for (found, want) in clusters.row_sums().iter().zip(pairs.row_sums()) {
        assert!((found - want).abs() < 0.01 * TOLERANCE, "a row sum of {found} for {want}");
    }
}

/// Triangles and quadrilaterals between any points.
fn heap(drawn: &mut Drawn) -> Result<Shape> {
    let size = drawn.one_of(&[1.0, 1.0, 1e-12, 1e3, 1e20]);
    let off = drawn.one_of(&[0.0, 0.0, 1e-12, 1e-9, 1e-7, 1e-4]);
    let coordinate = |drawn: &mut Drawn| {
        let place = drawn.byte();
        size * (f64::from(place % 16) / 8.0 + off * f64::from(place / 16))
    };
    let vertices: Vec<_> =
        (0..3 + drawn.below(12)).map(|_| std::array::from_fn(|_| coordinate(drawn))).collect();
    let face = |drawn: &mut Drawn| {
        let corners = 3 + usize::from(drawn.below(3) == 0);
        (0..corners).map(|_| drawn.below(vertices.len())).collect()
    };
    let faces = (0..1 + drawn.below(12)).map(|_| face(drawn)).collect();
    Ok(Shape::new(vertices, faces, vec![])?.0)
}

fn accordion(drawn: &mut Drawn) -> Result<Shape> {
    let angles = [0.1, 1.0, 20.0, 45.0, 90.0, 150.0, 179.0, 180.0];
    let (depth, facets) = (drawn.coarse([0.01, 10.0]), FacetGrid { rows: 1 + drawn.below(3), cols: 1 });
    Accordion {
        valley: Fold::new(drawn.one_of(&angles), 1.0, depth, facets)?,
        creases: 1 + drawn.below(6),
        ridge_deg: drawn.one_of(&angles),
        bow_deg: drawn.coarse([-180.0, 180.0]),
    }
    .shape()
}

/// Walls from the tip of a cone to points on it.
fn pit(drawn: &mut Drawn) -> Result<Shape> {
    let (walls, depth) = (3 + drawn.below(4), drawn.fine([0.01, 5.0]));
    let mut rim = |n: usize| {
        let turn = std::f64::consts::TAU * (n as f64 + drawn.fine([0.05, 0.95])) / walls as f64;
        let far = drawn.one_of(&[1.0, 1.0, 0.1, 3.0, 30.0]) * drawn.fine([0.5, 1.0]);
        [far * turn.cos(), far * turn.sin(), far * depth]
    };
    let vertices = (0..walls).map(&mut rim).chain([[0.0; 3]]).collect();
    let faces = (0..walls).map(|n| vec![n, (n + 1) % walls, walls]).collect();
    Ok(Shape::new(vertices, faces, vec![])?.0)
}

fn light(drawn: &mut Drawn, size: f64) -> Result<LightSource> {
    let kind = drawn.below(4);
    let [x, y, z] = std::array::from_fn(|_| drawn.coarse([-1.0, 1.0]));
    match kind {
        0 => LightSource::directional([x, y, z], 1.0),
        1 => LightSource::point([3.0 * size * x, 3.0 * size * y, 3.0 * size * z], 1.0, size),
        2 => LightSource::uniform_sky(1.0),
        _ => LightSource::overcast_sky([x, y, z], 1.0),
    }
}

/// No patch hands on more than it has, exchange is mutual, and what light becomes is light.
fn assert_lawful(shape: &Shape, patches: &[Patch], drawn: &mut Drawn) {
    let Some(source) = taken(light(drawn, shape.size())) else { return };
    let Some(lit) = taken(LitSurface::new(shape, &[source], patches, TOLERANCE)) else { return };
    let sums = lit.kernel.row_sums();
    assert!(sums.iter().all(|sum| (-TOLERANCE..1.0 + TOLERANCE).contains(sum)), "row sums {sums:?}");
    assert_mutual(&lit.kernel, drawn);
    let direct = &lit.lights[0].irradiance;
    assert!(direct.iter().all(|light| *light >= 0.0 && light.is_finite()), "direct light {direct:?}");
    let Some((response, _)) = taken(SurfaceResponse::solve(&lit.kernel, direct, TOLERANCE)) else { return };
    for r in [0.0, 0.5, 0.99, 1.0] {
        let irradiance: Vec<_> = (0..shape.len()).map(|facet| response.irradiance(facet, r)).collect();
        assert_finite("irradiance", &irradiance);
        let most = irradiance.iter().copied().fold(0.0, f64::max);
        assert!(irradiance.iter().all(|light| *light >= -TOLERANCE * most), "r = {r}: {irradiance:?}");
    }
}

/// `A_i K_ij = A_j K_ji`.
fn assert_mutual(kernel: &SurfaceKernel, drawn: &mut Drawn) {
    let areas: Vec<f64> = kernel.root_areas().iter().map(|root| root * root).collect();
    let rows: Vec<usize> = (0..ROWS).map(|_| usize::from(drawn.byte()) * 97 % areas.len()).collect();
    let shares: Vec<_> = rows.iter().map(|row| kernel.matrix_row(*row)).collect();
    for (i, of_i) in rows.iter().zip(&shares) {
        assert!(of_i.iter().all(|share| (-1e-6..1.0 + TOLERANCE).contains(share)), "row {i}: {of_i:?}");
        for (j, of_j) in rows.iter().zip(&shares) {
            let (there, back) = (areas[*i] * of_i[*j], areas[*j] * of_j[*i]);
            let most = areas[*i].min(areas[*j]);
            assert!((there - back).abs() <= 1e-9 * most, "{i} and {j}: {there} and {back} of {most}");
        }
    }
}
