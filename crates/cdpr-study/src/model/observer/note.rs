//! What is to be known of an output.

use crate::file::output::Output;
use crate::model::observer::OutputObserver;
use cdpr_dynamics::{Modes, Swing};
use cdpr_statics::{Deflection, DirectProblem};

impl OutputObserver<'_> {
    /// What is to be known of an output that is a vibration: cables take most part in the motion of a
    /// frequency, or nothing damps cables across their stretch.
    pub(crate) fn vibration_note(&self) -> Option<String> {
        /// Share of the platform below which the frequency is one of the cables.
        const SMALL: f64 = 0.5;
        let Deflection { lengths, loaded, .. } = &self.nominal;
        let problem = || DirectProblem::new(self.robot, lengths, &self.load).ok();
        let (share, more) = match self.output {
            Output::Deflection | Output::Position | Output::Stiffness => return None,
            Output::Amplitude => {
                let is_sharp = self.amplitude?.damping.drag == 0.0;
                return is_sharp.then(|| {
                    "amplitude: without `drag` nothing damps cables across their stretch, and near one of \
                     their frequencies the amplitude is far above a real one"
                        .to_owned()
                });
            }
            Output::Frequency => {
                let found = Modes::slowest(&problem()?, &loaded.equilibrium).ok()?;
                (found.lowest()?.platform_share, "")
            }
            Output::PlatformFrequency => {
                let found = Swing::new(&problem()?, &loaded.equilibrium).ok()?;
                (found.platform_share, "; from robot to robot it may be another motion")
            }
        };
        (share < SMALL).then(|| {
            format!(
                "{}: the platform has {:.1} % of the energy of this motion, cables the rest{more}",
                self.output.short(),
                100.0 * share
            )
        })
    }
}
