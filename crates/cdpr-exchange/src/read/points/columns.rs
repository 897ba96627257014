//! What the columns of a table of points mean: names in capitals, with spaces, points and units.

/// A column that was found.
pub(crate) struct Column {
    /// Its number, from 0.
    pub(crate) index: usize,
    /// SI units in its unit.
    pub(crate) factor: f64,
}

impl Column {
    /// A number of the column in SI units. It is divided by 1000 instead of multiplied by 0.001, which is no
    /// double: 175 mm are 0.175 m. Zero has no sign.
    pub(crate) fn in_si(&self, number: f64) -> f64 {
        let value = if self.factor < 1.0 { number / (1.0 / self.factor) } else { number * self.factor };
        value + 0.0
    }
}

/// What a column means.
pub(crate) struct Meaning {
    /// Its name in this program.
    pub(crate) name: &'static str,
    /// SI units in its unit.
    pub(crate) factor: f64,
    /// Whether a letter alone names the point.
    pub(crate) is_letter: bool,
}

/// Names in a message at most.
pub(crate) const NAMES: usize = 20;

/// Units with their size in SI units.
type Units = &'static [(&'static str, f64)];
const LENGTH: Units = &[("", 1.0), ("m", 1.0), ("cm", 1e-2), ("mm", 1e-3)];
const AREA: Units = &[("", 1.0), ("m2", 1.0), ("mm2", 1e-6)];
const DENSITY: Units = &[("", 1.0), ("kgm", 1.0), ("kgperm", 1.0), ("gm", 1e-3), ("gperm", 1e-3)];
const MODULUS: Units = &[("", 1.0), ("pa", 1.0), ("mpa", 1e6), ("gpa", 1e9)];
const FORCE: Units = &[("", 1.0), ("n", 1.0), ("kn", 1e3)];
const NONE: Units = &[("", 1.0)];

/// Names in this program, other names, units.
const COLUMNS: [(&str, &[&str], Units); 18] = [
    ("exit_x", &["exitx", "exitpointx", "bx"], LENGTH),
    ("exit_y", &["exity", "exitpointy", "by"], LENGTH),
    ("exit_z", &["exitz", "exitpointz", "bz"], LENGTH),
    ("anchor_x", &["anchorx", "anchorpointx", "ax"], LENGTH),
    ("anchor_y", &["anchory", "anchorpointy", "ay"], LENGTH),
    ("anchor_z", &["anchorz", "anchorpointz", "az"], LENGTH),
    ("radius", &["radius", "pulleyradius"], LENGTH),
    ("axis_x", &["axisx", "pulleyaxisx", "swivelaxisx"], NONE),
    ("axis_y", &["axisy", "pulleyaxisy", "swivelaxisy"], NONE),
    ("axis_z", &["axisz", "pulleyaxisz", "swivelaxisz"], NONE),
    ("lead", &["lead"], LENGTH),
    ("section", &["section"], AREA),
    ("linear_density", &["lineardensity"], DENSITY),
    ("youngs_modulus", &["youngsmodulus", "modulus"], MODULUS),
    ("diameter", &["diameter"], LENGTH),
    ("breaking_force", &["breakingforce", "breakingload"], FORCE),
    ("tension_min", &["tensionmin", "mintension", "tmin"], FORCE),
    ("tension_max", &["tensionmax", "maxtension", "tmax"], FORCE),
];

/// What a name of a column means, if it is known.
pub(crate) fn meaning(name: &str) -> Option<Meaning> {
    let name = plain(name);
    COLUMNS.iter().find_map(|(column, others, units)| {
        others.iter().find_map(|other| {
            let unit = name.strip_prefix(other)?;
            let (_, factor) = units.iter().find(|(known, _)| *known == unit)?;
            Some(Meaning { name: column, factor: *factor, is_letter: other.len() == 2 })
        })
    })
}

/// Whether a column only names or describes a cable.
pub(crate) fn harmless(name: &str) -> bool {
    const HARMLESS: [&str; 17] = [
        "cable",
        "cables",
        "id",
        "name",
        "no",
        "nr",
        "number",
        "index",
        "i",
        "color",
        "colour",
        "comment",
        "note",
        "notes",
        "remark",
        "description",
        "label",
    ];
    HARMLESS.contains(&plain(name).as_str())
}

/// Whether a column numbers the cables.
pub(crate) fn is_number(name: &str) -> bool {
    ["cable", "cables", "no", "nr", "number", "index"].contains(&plain(name).as_str())
}

/// Letters and digits alone, in lower case.
fn plain(name: &str) -> String {
    let digits = name.chars().map(|c| if c == '²' { '2' } else { c });
    digits.filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
