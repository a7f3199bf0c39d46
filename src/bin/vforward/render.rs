//! The photograph requested by `--render`.

use std::path::PathBuf;

use clap::Args;
use nalgebra::Vector3;
use vfold::cli::{self, Common};
use vfold::forward::render::{Frame, Viewpoint};
use vfold::stream::Corners;
use vfold::{Error, Result};

#[derive(Args)]
#[command(next_help_heading = "Photograph")]
pub struct RenderArgs {
    /// Also take a photograph of the first sheet: camera RGB as .exr or 16-bit .tif, or for the eye as .png
    /// (sRGB)
    #[arg(long, value_name = "FILE")]
    pub render: Option<PathBuf>,
    /// Size of the photograph, px
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "640x480", value_parser = cli::pair::<usize>)]
    render_size: (usize, usize),
    /// Position of the camera, in the unit of the panels, for --render and for sheets that are not
    /// perfectly matte [default: a few degrees off the sun's direction]
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    eye: Option<Vector3<f64>>,
    /// Point that the camera looks at [default: the middle of the sheet]
    #[arg(long, value_name = "X,Y,Z", requires = "render", value_parser = point, allow_hyphen_values = true)]
    look_at: Option<Vector3<f64>>,
    /// Direction that points upwards in the photograph [default: the crease]
    #[arg(long, value_name = "X,Y,Z", requires = "render", value_parser = point, allow_hyphen_values = true)]
    up: Option<Vector3<f64>>,
    /// Horizontal field of view, degrees, between 0 and 180 [default: fits the sheet]
    #[arg(long, value_name = "DEG", requires = "render")]
    field_of_view_deg: Option<f64>,
}

impl RenderArgs {
    /// # Errors
    /// [`Error::Usage`] for a camera without a purpose: a perfectly matte sheet has the same facets from
    /// every viewpoint.
    pub fn check(&self, is_seen: bool) -> Result<()> {
        if self.eye.is_none() || self.render.is_some() || is_seen {
            return Ok(());
        }
        let problem = "a perfectly matte sheet looks the same from everywhere";
        Err(Error::usage(
            "--eye",
            problem,
            "leave it out, or add --render, --specular-weight, --body-roughness-deg or --sheen",
        ))
    }

    /// # Errors
    /// As [`Frame::new`].
    pub fn frame(&self) -> Result<Frame> {
        Frame::new(self.render_size.0, self.render_size.1)
    }

    /// Width and height, px.
    pub fn size(&self) -> [usize; 2] {
        [self.render_size.0, self.render_size.1]
    }

    pub fn viewpoint(&self) -> Viewpoint {
        let Self { eye, look_at, up, field_of_view_deg, .. } = *self;
        Viewpoint { eye, look_at, up, field_of_view_deg }
    }

    /// Prints the flags that give vextract the panels' positions in the photograph, if one was taken.
    pub fn say_corners(&self, panels: &[(usize, Corners)], common: &Common) {
        let Some(path) = self.render.as_ref().filter(|_| !common.quiet && !panels.is_empty()) else { return };
        let flag = |(number, corners): &(usize, Corners)| {
            let corners = corners.map(|corner| format!("{:.2},{:.2}", corner.x, corner.y)).join(" ");
            match number {
                0 | 1 => format!("--panel{number} \"{corners}\""),
                _ => format!("--panel {number}=\"{corners}\""),
            }
        };
        let flags: Vec<String> = panels.iter().map(flag).collect();
        cli::say("vforward", &format!("{} has its corners at {}", path.display(), flags.join(" ")));
    }
}

fn point(text: &str) -> std::result::Result<Vector3<f64>, String> {
    cli::vector(text).map(Vector3::from)
}
