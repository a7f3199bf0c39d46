//! Where the panels are in a photograph.

use clap::Args;
use vfold::image::{Homography, PANEL_CORNERS, parse_corners};
use vfold::{Error, Result};

#[derive(Args)]
pub struct RegionArgs {
    /// Corners of panel 0
    #[arg(long, value_name = "x,y x,y x,y x,y", required_unless_present_any = ["generate", "list", "preview"], allow_hyphen_values = true)]
    panel0: Option<String>,
    /// Corners of panel 1 [default: only panel 0 is measured]
    #[arg(long, value_name = "x,y x,y x,y x,y", allow_hyphen_values = true)]
    panel1: Option<String>,
    /// Stay this far from the panels' edges
    #[arg(long, value_name = "PX", default_value_t = 0.0, allow_negative_numbers = true)]
    pub margin: f64,
}

impl RegionArgs {
    /// Where each panel lies.
    ///
    /// # Errors
    /// [`Error::Usage`] if corners do not outline two panels side by side, or the margin is no distance.
    pub fn panels(&self) -> Result<Vec<Homography>> {
        if !(self.margin >= 0.0 && self.margin.is_finite()) {
            let problem = format!("{} is not a distance", self.margin);
            return Err(Error::usage("--margin", problem, "give pixels, 0 or more"));
        }
        let given = [("--panel0", &self.panel0), ("--panel1", &self.panel1)];
        let panels: Vec<Homography> = given
            .into_iter()
            .filter_map(|(flag, text)| text.as_ref().map(|text| (flag, text)))
            .map(|(flag, text)| Homography::from_unit_square(parse_corners(flag, text, &PANEL_CORNERS)?))
            .collect::<Result<_>>()?;
        if let [panel0, panel1] = panels.as_slice() {
            let (u, v) = panel0.to_panel(panel1.to_image(0.5, 0.5));
            if (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v) {
                let problem = "the middle of panel 1 lies inside panel 0";
                return Err(Error::usage(
                    "--panel1",
                    problem,
                    "the panels meet at the crease and nowhere else",
                ));
            }
        }
        Ok(panels)
    }
}
