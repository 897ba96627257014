//! What is off by so much that it can only be in another unit: a question would not be enough.

use crate::error::RobotError;
use crate::robot::{Robot, RobotCable};

/// Young's modulus below which nothing is a cable [Pa]: soft rubber.
const SOFTEST: f64 = 1e6;

/// Axial stiffness below which a cable of such a modulus carries nothing [N]: at 10 % strain, a kilogram.
const LEAST_STIFFNESS: f64 = 100.0;

/// Distance of exit points beyond which nothing is a robot [m]: the widest, a telescope, has 600 m.
const WIDEST: f64 = 2000.0;

impl Robot {
    /// Refuses values that are off by so much that they must be in another unit: a modulus below that of
    /// any cable, points farther apart than those of any robot.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] names the field and says what its value would be in the unit that was meant.
    pub fn check_units(&self) -> Result<(), RobotError> {
        for (i, cable) in self.cables.iter().enumerate() {
            let (modulus, stiffness) = (cable.properties.youngs_modulus, cable.properties.axial_stiffness());
            // Not where EA is given as the modulus of a unit section.
            if modulus < SOFTEST && stiffness < LEAST_STIFFNESS {
                let expected = format!(
                    "a modulus in Pa, soft rubber has {SOFTEST:e}: {modulus} GPa is {:e}, {modulus} MPa is {:e}",
                    1e9 * modulus,
                    1e6 * modulus
                );
                return Err(RobotError::invalid(self.field(i, "youngs_modulus"), modulus, expected));
            }
        }
        let first = self.cables[0].exit_point;
        let far = |(_, cable): &(usize, &RobotCable)| (cable.exit_point - first).norm();
        let farthest = self.cables.iter().enumerate().max_by(|a, b| far(a).total_cmp(&far(b)));
        if let Some((i, cable)) = farthest.filter(|cable| far(cable) > WIDEST) {
            return Err(RobotError::invalid(
                format!("cables[{i}].exit_point"),
                format!("{:?}, {:.0} m from that of cable 1", cable.exit_point.as_slice(), far(&(i, cable))),
                format!("coordinates in m, less than {WIDEST} m apart: from mm, divide by 1000"),
            ));
        }
        Ok(())
    }
}
