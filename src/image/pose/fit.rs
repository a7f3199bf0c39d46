//! Least-squares fit of the unknowns to the positions of corners.
//!
//! ## Reference
//! D. W. Marquardt, *An algorithm for least-squares estimation of nonlinear parameters* (1963); evidence by
//! the Laplace approximation: C. M. Bishop, *Pattern Recognition and Machine Learning* (2006), section 4.4.

use nalgebra::{Rotation3, SMatrix, SVector, Vector3};

use super::prior::{EXPECTED, Hypothesis};
use super::view::{ANGLE, Corners, LN_SIZE, MIDDLE, UNKNOWNS, Unknowns, seen};

/// Two coordinates of six corners, and the prior means.
const RESIDUALS: usize = 12 + EXPECTED;
type Residuals = SVector<f64, RESIDUALS>;
type Jacobian = SMatrix<f64, RESIDUALS, UNKNOWNS>;
type Square = SMatrix<f64, UNKNOWNS, UNKNOWNS>;

/// Most steps of a search, and the decrease of the cost below which it ends.
const STEPS: usize = 60;
const SMALL_FALL: f64 = 1e-9;
/// Initial damping, its factors after an unsuccessful and a successful step, and its limit.
const DAMPING: f64 = 1e-2;
const DAMPING_UP: f64 = 8.0;
const DAMPING_DOWN: f64 = 0.2;
const DAMPING_MOST: f64 = 1e8;
/// Step of the central differences, for unknowns near 1.
const DIFFERENCE: f64 = 1e-5;
/// Initial angles of the searches, radians, and initial turns of the fold around the crease and across it.
const FIRST_ANGLES: [f64; 2] = [0.6, 1.4];
const FIRST_TURNS: [f64; 3] = [-0.5, 0.0, 0.5];
/// A fold with an angle outside this range, radians, is closed or flat.
const ANGLES: std::ops::Range<f64> = 0.02..3.12;

/// A minimum of the cost.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fitted {
    pub unknowns: Unknowns,
    /// Standard deviation of the angle, radians.
    pub angle_sd: f64,
    /// Sum of the squares of all residuals.
    pub squares: f64,
    /// Log probability of the corners under the hypothesis times its prior share, up to a constant.
    pub ln_evidence: f64,
}

impl Fitted {
    /// Ratio of the corners' residuals to their expected size.
    pub fn reduced_chi(&self) -> f64 {
        (self.squares / (RESIDUALS - UNKNOWNS) as f64).max(1.0).sqrt()
    }

    /// The same log probability if all standard deviations are larger by the factor `reduced_chi`.
    pub fn ln_evidence_at(&self, reduced_chi: f64) -> f64 {
        self.ln_evidence + 0.5 * self.squares * (1.0 - reduced_chi.powi(-2))
    }
}

/// Observed corners and their standard deviation.
pub(super) struct Sighting {
    pub corners: Corners,
    pub sd: f64,
}

impl Sighting {
    /// All minima under a hypothesis, from several initial guesses, possibly with duplicates.
    pub fn fit(&self, hypothesis: &Hypothesis) -> Vec<Fitted> {
        let guesses = FIRST_ANGLES.iter().flat_map(|angle| {
            FIRST_TURNS
                .iter()
                .flat_map(move |across| FIRST_TURNS.iter().map(move |yaw| (*angle, *across, *yaw)))
        });
        guesses.filter_map(|guess| self.descend(hypothesis, guess)).collect()
    }

    /// The minimum reached from one initial guess: the angle, and turns across and around the crease.
    fn descend(&self, hypothesis: &Hypothesis, (angle, across, yaw): (f64, f64, f64)) -> Option<Fitted> {
        let crease = self.corners[1] - self.corners[0];
        let roll = crease.x.atan2(-crease.y);
        let turn = |axis: usize, angle: f64| Rotation3::new(Vector3::ith(axis, angle));
        // y upwards and the opening towards the camera, then turned to the apparent direction of the crease
        let held = turn(2, roll) * turn(0, across) * turn(1, yaw) * turn(0, std::f64::consts::PI);
        let mut unknowns = Unknowns::zeros();
        hypothesis.expected.iter().for_each(|expected| unknowns[expected.unknown] = expected.mean);
        unknowns[ANGLE] = angle;
        unknowns.fixed_rows_mut::<2>(MIDDLE).copy_from(&((self.corners[0] + self.corners[1]) / 2.0));
        unknowns[LN_SIZE] = (crease.norm() / across.cos()).ln();
        let problem = Problem { sighting: self, hypothesis, held };
        problem.minimise(unknowns)
    }
}

/// The objective: half the sum of squared residuals.
struct Problem<'a> {
    sighting: &'a Sighting,
    hypothesis: &'a Hypothesis,
    /// Initial orientation of the fold relative to the camera.
    held: Rotation3<f64>,
}

impl Problem<'_> {
    /// Levenberg-Marquardt; none if there is no minimum with the fold in front of the camera.
    fn minimise(&self, mut unknowns: Unknowns) -> Option<Fitted> {
        let mut residuals = self.residuals(&unknowns)?;
        let mut damping = DAMPING;
        for _ in 0..STEPS {
            let jacobian = self.jacobian(&unknowns)?;
            let (normal, slope) = (jacobian.tr_mul(&jacobian), jacobian.tr_mul(&residuals));
            let fall = loop {
                let damped = normal + damping * Square::from_diagonal(&normal.diagonal());
                let trial = unknowns - damped.cholesky()?.solve(&slope);
                let better =
                    self.residuals(&trial).filter(|other| other.norm_squared() < residuals.norm_squared());
                if let Some(better) = better {
                    let fall = residuals.norm_squared() - better.norm_squared();
                    (unknowns, residuals) = (trial, better);
                    damping *= DAMPING_DOWN;
                    break fall;
                }
                damping *= DAMPING_UP;
                if damping > DAMPING_MOST {
                    break 0.0;
                }
            };
            if fall < SMALL_FALL {
                break;
            }
        }
        self.fitted(unknowns, &residuals)
    }

    /// Results at a minimum.
    fn fitted(&self, unknowns: Unknowns, residuals: &Residuals) -> Option<Fitted> {
        let jacobian = self.jacobian(&unknowns)?;
        let factor = jacobian.tr_mul(&jacobian).cholesky()?;
        let ln_determinant = 2.0 * factor.l_dirty().diagonal().map(f64::ln).sum();
        let expected = self.hypothesis.expected.iter();
        let ln_prior = self.hypothesis.share.ln() - expected.map(|expected| expected.sd.ln()).sum::<f64>();
        let squares = residuals.norm_squared();
        let ln_evidence = ln_prior - 0.5 * (squares + ln_determinant);
        let angle_sd = factor.inverse()[(ANGLE, ANGLE)].sqrt();
        let found = Fitted { unknowns, angle_sd, squares, ln_evidence };
        // corners that the model does not explain are less accurate than assumed
        Some(Fitted { angle_sd: found.reduced_chi() * angle_sd, ..found })
    }

    /// Positions predicted by the model minus observed ones, then unknowns minus their prior means, each over
    /// its standard deviation.
    fn residuals(&self, unknowns: &Unknowns) -> Option<Residuals> {
        let seen = ANGLES.contains(&unknowns[ANGLE]).then(|| seen(unknowns, &self.held)).flatten()?;
        let mut residuals = Residuals::zeros();
        for (k, (model, corner)) in seen.iter().zip(&self.sighting.corners).enumerate() {
            residuals.fixed_rows_mut::<2>(2 * k).copy_from(&((model - corner) / self.sighting.sd));
        }
        for (k, expected) in self.hypothesis.expected.iter().enumerate() {
            residuals[12 + k] = (unknowns[expected.unknown] - expected.mean) / expected.sd;
        }
        residuals.iter().all(|residual| residual.is_finite()).then_some(residuals)
    }

    /// Derivatives of the residuals, by central differences.
    fn jacobian(&self, unknowns: &Unknowns) -> Option<Jacobian> {
        let mut jacobian = Jacobian::zeros();
        for (k, mut column) in jacobian.column_iter_mut().enumerate() {
            let step = DIFFERENCE * Unknowns::ith(k, 1.0);
            let (above, below) = (self.residuals(&(unknowns + step))?, self.residuals(&(unknowns - step))?);
            column.copy_from(&((above - below) / (2.0 * DIFFERENCE)));
        }
        Some(jacobian)
    }
}
