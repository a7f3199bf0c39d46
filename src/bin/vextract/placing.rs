//! Refines the positions of panels.

use std::ops::RangeInclusive;

use clap::Args;
use vfold::image::{Grid, Lens, LensEstimate, Photograph, REFINED_WITHIN_PX, Refinement, refine};
use vfold::scene::MarkedPanels;
use vfold::{Error, Result, cli};

#[derive(Args)]
pub struct PlacingArgs {
    /// Move the panels' corners to the edges and the crease within PX pixels, 1 to 100, instead of 6, and
    /// report sides that have no edge
    #[arg(long, value_name = "PX", num_args = 0..=1, require_equals = true, default_missing_value = "6")]
    refine: Option<f64>,
    /// Use the corners as marked, without moving them to the edges; those of the crease are where the
    /// panels would meet if it were sharp
    #[arg(long, conflicts_with = "refine")]
    exact_corners: bool,
    /// Lens distortion about the picture's centre: seen radius r (1 + K1 r² + K2 r⁴), r in units of half the
    /// shorter side [default: K1 from the bend of the panels' outer sides, unless --exact-corners]
    #[arg(long, value_name = "K1,K2", value_parser = coefficients, allow_hyphen_values = true)]
    distortion: Option<[f64; 2]>,
}

/// Panels in a photograph.
pub struct Placed {
    pub grids: Vec<Grid>,
    pub refinement: Option<Refinement>,
    /// The lens, if anything is known of it.
    pub lens: Option<LensEstimate>,
}

impl Placed {
    pub fn lens(&self) -> Lens {
        self.lens.map_or(Lens::STRAIGHT, |known| known.lens)
    }
}

impl PlacingArgs {
    /// # Errors
    /// [`Error::Usage`] if the reach is not a valid distance.
    pub fn check(&self) -> Result<()> {
        let px = self.reach_px();
        if REACH_PX.contains(&px) {
            return Ok(());
        }
        let problem = format!("{px} px is out of range");
        let remedy = format!("give {} to {}, such as --refine=6", REACH_PX.start(), REACH_PX.end());
        Err(Error::usage("--refine", problem, remedy))
    }

    /// Search distance for edges around the corners, px.
    fn reach_px(&self) -> f64 {
        self.refine.unwrap_or(REFINED_WITHIN_PX)
    }

    /// Whether sides without edges are to be reported.
    pub fn asks_for_edges(&self) -> bool {
        self.refine.is_some()
    }

    /// The lens of a photograph, if stated.
    ///
    /// # Errors
    /// As [`Lens::new`].
    pub fn stated_lens(&self, photograph: &Photograph) -> Result<Option<LensEstimate>> {
        let lens = self.distortion.map(|k| Lens::new(k, photograph.width(), photograph.height()));
        Ok(lens.transpose()?.map(LensEstimate::stated))
    }

    /// What is known of the lens before any corners are.
    ///
    /// # Errors
    /// As [`Lens::new`].
    pub fn lens(&self, photograph: &Photograph) -> Result<LensEstimate> {
        Ok(self.stated_lens(photograph)?.unwrap_or(LensEstimate::UNKNOWN))
    }

    /// Panels with these corners, through their lens. Corners that were `found` with a lens are at the edges
    /// already; others are refined unless they are exact.
    ///
    /// # Errors
    /// As [`PlacingArgs::lens`], [`refine`] and [`MarkedPanels::grids`].
    pub fn place(
        &self,
        photograph: &Photograph,
        panels: &MarkedPanels,
        found: Option<LensEstimate>,
    ) -> Result<Placed> {
        let known = self.lens(photograph)?;
        let is_placed = self.exact_corners || (found.is_some() && self.refine.is_none());
        let refinement = (!is_placed).then(|| refine(photograph, &panels.marked, &known, self.reach_px()));
        let refinement = refinement.transpose()?;
        let (corners, lens): (Vec<_>, _) = match &refinement {
            Some(refinement) => (refinement.panels.clone(), Some(refinement.lens)),
            None => {
                let corners = panels.marked.iter().map(|panel| panel.corners);
                (corners.collect(), found.or(self.stated_lens(photograph)?))
            }
        };
        let mut placed = Placed { grids: Vec::new(), refinement, lens };
        placed.grids = panels.grids(placed.lens(), corners)?;
        Ok(placed)
    }
}

/// An edge is found where pixels differ, not within one; corners further off should be marked again.
const REACH_PX: RangeInclusive<f64> = 1.0..=100.0;

/// Reports displacements of corners if `verbose`, and sides without edges unless `quiet`.
pub fn report(refinement: &Refinement, name: &str, verbose: bool, quiet: bool) {
    let missing = refinement.sides_without_edge.join(", ");
    if verbose {
        let panel = |moved: &[f64; 4]| moved.map(|px| format!("{px:.2}")).join(" ");
        let moved: Vec<_> = refinement.moved_px.iter().map(panel).collect();
        let missing = if missing.is_empty() { String::new() } else { format!("; no edge at {missing}") };
        cli::say("vextract", &format!("{name}: corners moved by {} px{missing}", moved.join(" / ")));
    } else if !quiet && refinement.sides_without_edge.iter().any(|side| !side.starts_with("crease")) {
        let remedy = "check with --overlay";
        cli::say("vextract", &format!("{name}: no edge at {missing}: left as marked; {remedy}"));
    }
}

fn coefficients(text: &str) -> std::result::Result<[f64; 2], String> {
    let parse = |part: &str| part.trim().parse::<f64>().ok();
    let pair = text.split_once(',').unwrap_or((text, "0"));
    match (parse(pair.0), parse(pair.1)) {
        (Some(k1), Some(k2)) => Ok([k1, k2]),
        _ => Err("write K1,K2 or K1, such as -0.021,0.003".to_owned()),
    }
}
