//! Moves from rest to rest: the lengths over time with which a platform follows a way and does not swing.
//!
//! The share u of the way follows a profile that an input shaper splits, `u(t) = sum A_i s((t - t_i)/T)`. The
//! lengths are those of the inverse model at each pose, under the wrench with which the motion resists
//! (d'Alembert), about P in the base frame,
//!
//! ```text
//! f = -m (a + α x c + ω x (ω x c)),      m_P = c x f - I α - ω x I ω                                (N16)
//! w = (f, m_P) + sum (r_i, s_i x r_i),
//! r_i = -M_i a_i - W_i L''_i,      a_i = a + α x s_i,      L''_i = e_i·a_i                          (N17)
//! ```
//!
//! with the lever c of the centre of mass, the direction e_i from exit to anchor point and the lever s_i of
//! the latter. `M_i` and `W_i` are the inertia of a cable: the terms in ω² of the dynamic stiffness of its end
//! and of the force by which a winch moves it, (N12), at low frequencies. L'' is what keeps the sag of a
//! cable whose anchor point accelerates. Distances grow at constant speed, too, where they turn; the cable is
//! then paid out without a change of its sag, which nothing resists.
//!
//! The static model under w has the forces of the cables without their own inertia, T_i t_i at the anchor
//! point and T_E,i at the exit. Those in motion are
//!
//! ```text
//! |T_i t_i - r_i|,      T_E,i - W_i·a_i - Z_i L''_i,      Z_i = m_i - t_i·M_i t_i - 2 W_i·t_i       (N24)
//! ```
//!
//! with the mass m_i and the direction t_i at the anchor point: a cable that runs along its own shape,
//! `a_i = t_i L''_i`, moves everywhere as fast. Lengths at rest have kinks where a cable
//! comes to its least tension, and those with feed-forward jump in their rate at both ends of a move.
//! Lengths and poses then belong to each other to second order in ω over the cables' own frequencies; what
//! the cables swing themselves is left to the shaper.

mod excited;
mod inertia;
mod residual;
mod shaper;
mod tensions;
mod way;

use crate::error::{DynamicsError, positive};
use crate::simulate::{Profile, WinchLengths};
use cdpr_robot::{Pose, Robot, Vector3, Vector6};
use cdpr_statics::{InversePath, Load, StaticsError};
pub use excited::Excited;
use inertia::{CableInertia, Resistance, resistance};
pub use residual::{Residual, residual};
pub use shaper::{Shaper, ShaperKind};
use way::{Motion, Way};

/// Which inertia the lengths of a move account for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FeedForward {
    /// None: at each time the lengths are those of a platform at rest there. The tensions are those of the
    /// motion all the same.
    #[default]
    None,
    /// That of platform and payload, (N16).
    Platform,
    /// That of the cables, too, (N17).
    Cables,
}

impl FeedForward {
    /// Those that account for inertia, with their names.
    pub const NAMED: [(&str, Self); 2] = [("platform", Self::Platform), ("cables", Self::Cables)];

    /// The profile that is taken where none is given.
    ///
    /// Lengths follow the acceleration only where it does not jump.
    pub fn usual_profile(self) -> Profile {
        if self == Self::None { Profile::Cosine } else { Profile::Polynomial }
    }
}

/// A move from rest to rest.
#[derive(Clone, Debug)]
pub struct Move<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// Load on the platform, at rest and in motion.
    pub load: Load,
    /// The poses of the way, two or more.
    pub poses: &'a [Pose],
    /// Duration, that of the shaper included [s].
    pub seconds: f64,
    /// How the share of the way changes over time.
    pub profile: Profile,
    /// What it is split by.
    pub shaper: Shaper,
    /// Which inertia is accounted for.
    pub feed_forward: FeedForward,
    /// Set points for each second [Hz].
    pub rate: f64,
}

/// Set points of a move.
#[derive(Clone, Debug, PartialEq)]
pub struct SetPoint {
    /// Time [s].
    pub time: f64,
    /// The wanted pose.
    pub pose: Pose,
    /// Unstrained lengths [m].
    pub lengths: Vec<f64>,
    /// Their part for the motion: the differences to those at rest there [m].
    pub feed_forward: Vec<f64>,
    /// Tensions at the platform in motion [N].
    pub tensions: Vec<f64>,
    /// Tensions at the exit points in motion [N].
    pub exit_tensions: Vec<f64>,
}

/// A load with a wrench that depends on the motion and the time.
type Resisted<'f> = &'f dyn Fn(f64, &Motion) -> Load;

impl Move<'_> {
    /// The set points, from the begin to the end of the move.
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for settings that are not possible, such as a shaper that takes longer than
    /// the move; [`DynamicsError::TooFast`] where no tensions within the limits accelerate the platform as
    /// wanted; [`DynamicsError::Jump`] where the lengths jump; those of the inverse model at rest, and of
    /// [`crate::FrequencyResponse::new`] with [`FeedForward::Cables`].
    pub fn plan(&self) -> Result<Vec<SetPoint>, DynamicsError> {
        let way = self.check()?;
        let at_rest = self.set_points(&way, &|_, _| self.load)?;
        if self.feed_forward == FeedForward::None {
            return self.with_tensions(&way, at_rest);
        }
        let mut found = self.in_motion(&way)?;
        for (point, still) in found.iter_mut().zip(&at_rest) {
            let both = point.lengths.iter().zip(&still.lengths);
            point.feed_forward = both.map(|(length, still)| length - still).collect();
        }
        self.with_tensions(&way, found)
    }

    /// Length of the smooth curve through the poses along which P moves [m].
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for poses that are no way.
    pub fn way_length(&self) -> Result<f64, DynamicsError> {
        Ok(self.way()?.length())
    }

    /// The set points with feed-forward.
    fn in_motion(&self, way: &Way) -> Result<Vec<SetPoint>, DynamicsError> {
        if self.feed_forward == FeedForward::Cables {
            let wrenches = Wrenches::new(self, way)?;
            return self.set_points(way, &|time, motion| wrenches.load(motion, &wrenches.own(time, motion)));
        }
        self.check_inertia(way)?;
        self.set_points(way, &|_, motion| self.with(self.of_platform(motion)))
    }

    /// What a robot may lack, the inertia, it lacks at all poses.
    fn check_inertia(&self, way: &Way) -> Result<(), DynamicsError> {
        resistance(self.robot, &self.load, &way.at([0.0; 3]))?;
        Ok(())
    }

    /// (N16).
    fn of_platform(&self, motion: &Motion) -> Vector6<f64> {
        resistance(self.robot, &self.load, motion).unwrap_or_default()
    }

    fn with(&self, wrench: Vector6<f64>) -> Load {
        let wrench = self.load.wrench + cdpr_robot::Wrench::from_vector(&wrench);
        Load { wrench, ..self.load }
    }

    /// The way, if the settings are possible.
    fn check(&self) -> Result<Way, DynamicsError> {
        const MOST_SET_POINTS: f64 = 1e6;
        positive("seconds", self.seconds, "a duration [s] above zero")?;
        positive("rate", self.rate, "set points for each second [Hz], above zero")?;
        let wrong =
            |field, value: String, expected: String| Err(DynamicsError::Invalid { field, value, expected });
        if self.profile == Profile::Linear {
            let expected = "trapezoid, cosine or polynomial: a linear one begins with a jump of the speed";
            return wrong("profile", "linear".to_owned(), expected.to_owned());
        }
        if self.feed_forward != FeedForward::None && self.profile != Profile::Polynomial {
            let expected = "polynomial with feed-forward: lengths would jump as the acceleration does";
            return wrong("profile", format!("{:?}", self.profile).to_lowercase(), expected.to_owned());
        }
        let shaper = self.shaper.duration();
        if self.seconds <= shaper {
            let expected = format!("more than the {shaper:.4} s that the shaper takes");
            return wrong("seconds", format!("{:?}", self.seconds), expected);
        }
        let count = self.seconds * self.rate;
        if !(2.0..=MOST_SET_POINTS).contains(&count) {
            let expected = format!("2 to {MOST_SET_POINTS:.0e} set points in {:?} s", self.seconds);
            return wrong("rate", format!("{:?} Hz", self.rate), expected);
        }
        self.way()
    }

    fn way(&self) -> Result<Way, DynamicsError> {
        Way::new(self.poses, self.robot.platform_size())
    }

    /// Share of the way at a time [s], its rate and the rate of that.
    fn share_at(&self, time: f64) -> [f64; 3] {
        let own = self.seconds - self.shaper.duration();
        let mut sum = [0.0; 3];
        for [later, amplitude] in &self.shaper.impulses {
            let [share, rate, growth] = self.profile.at((time - later) / own);
            sum[0] += amplitude * share;
            sum[1] += amplitude * rate / own;
            sum[2] += amplitude * growth / (own * own);
        }
        sum
    }

    fn set_points(&self, way: &Way, load: Resisted) -> Result<Vec<SetPoint>, DynamicsError> {
        let mut path = InversePath::new(self.robot);
        let count = (self.seconds * self.rate).ceil() as usize;
        // The platform rests before the first and after the last one.
        let times = (0..=count).map(|k| self.seconds * k as f64 / count as f64);
        let mut set_points = Vec::with_capacity(count + 1);
        for (k, time) in times.enumerate() {
            let motion = way.at(self.share_at(time));
            let is_end = k == 0 || k == count;
            let load = if is_end { self.load } else { load(time, &motion) };
            let found = path.solve(motion.pose, &load).map_err(|error| self.refused(time, &motion, error))?;
            if found.jump && !is_smooth(&set_points, &found.solution.lengths) {
                return Err(DynamicsError::Jump { time, position: motion.pose.position.into() });
            }
            let solution = found.solution;
            let exit_tensions = solution.equilibrium.exit_tensions(self.robot, &solution.lengths);
            set_points.push(SetPoint {
                time,
                pose: motion.pose,
                feed_forward: vec![0.0; solution.lengths.len()],
                lengths: solution.lengths,
                tensions: solution.tensions,
                exit_tensions,
            });
        }
        Ok(set_points)
    }

    /// Why a pose is not reached: by the motion or by itself.
    fn refused(&self, time: f64, motion: &Motion, error: StaticsError) -> DynamicsError {
        let cable = match &error {
            StaticsError::NoTensions { blocked, .. } => blocked.first().map(|blocked| blocked.index),
            StaticsError::ExitLimit { index, .. }
            | StaticsError::Cable { index, .. }
            | StaticsError::Overstrained { index, .. } => Some(*index),
            _ => return error.into(),
        };
        match cdpr_statics::inverse(self.robot, &motion.pose, &self.load) {
            Ok(_) => DynamicsError::TooFast {
                time,
                position: motion.pose.position.into(),
                cable,
                source: Box::new(error),
            },
            Err(at_rest) => at_rest.into(),
        }
    }
}

/// The wrenches with which platform and cables resist a move, (N17).
struct Wrenches<'a> {
    of: &'a Move<'a>,
    inertia: CableInertia,
}

impl<'a> Wrenches<'a> {
    fn new(of: &'a Move, way: &Way) -> Result<Self, DynamicsError> {
        of.check_inertia(way)?;
        Ok(Self { of, inertia: CableInertia::along(of.robot, &of.load, way)? })
    }

    /// How the cables resist at a time [s].
    fn own(&self, time: f64, motion: &Motion) -> Vec<Resistance> {
        let Move { robot, .. } = self.of;
        let [a, turn] = [0, 3].map(|k| Vector3::from(motion.acceleration.fixed_rows::<3>(k)));
        let ends = (0..robot.cables.len()).map(|i| {
            let anchor = a + turn.cross(&robot.anchor_arm(&motion.pose, i));
            (anchor, robot.span(&motion.pose, i).normalize().dot(&anchor))
        });
        self.inertia.resistance(self.of.share_at(time)[0], &ends.collect::<Vec<_>>())
    }

    /// The load with the wrench of platform and cables.
    fn load(&self, motion: &Motion, own: &[Resistance]) -> Load {
        let mut wrench = self.of.of_platform(motion);
        for (i, Resistance { force, .. }) in own.iter().enumerate() {
            let moment = self.of.robot.anchor_arm(&motion.pose, i).cross(force);
            wrench += Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        }
        self.of.with(wrench)
    }
}

/// Whether lengths go on as those of the last set points did: their branch may end where another one begins.
fn is_smooth(set_points: &[SetPoint], lengths: &[f64]) -> bool {
    /// Greatest change of a step, relative to the length.
    const SMOOTH: f64 = 1e-5;
    let [.., before, last] = set_points else { return false };
    let steps = lengths.iter().zip(before.lengths.iter().zip(&last.lengths));
    let mut changes = steps.map(|(next, (before, last))| (next - 2.0 * last + before).abs() / last);
    changes.all(|change| change <= SMOOTH)
}

/// The lengths of set points as winches follow them.
///
/// # Errors
/// [`DynamicsError::Invalid`] for fewer than two set points.
pub fn winch_lengths(set_points: &[SetPoint]) -> Result<WinchLengths, DynamicsError> {
    let times: Vec<f64> = set_points.iter().map(|point| point.time).collect();
    let rows: Vec<Vec<f64>> = set_points.iter().map(|point| point.lengths.clone()).collect();
    WinchLengths::new(&times, &rows)
}
