//! Robots and cables that come with the program: the files of `data/robots` and of `data/cables`.
//!
//! Links in the folder of this crate lead to them, so that they are part of it when it is packed.

/// A file of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LibraryFile {
    /// Name by which it is called, that of its file.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
}

macro_rules! files {
    ($folder:literal: $($name:literal)*) => {
        &[$(LibraryFile {
            name: $name,
            text: include_str!(concat!("../../data/", $folder, "/", $name, ".json")),
        }),*]
    };
}

/// Robots (`cdpr-robot/1`), by name.
pub const ROBOTS: &[LibraryFile] = files!("robots":
    "acrobot" "cable-robot-simulator" "caroca" "caroca-law" "cogiro" "copacabana-handling"
    "copacabana-inspection" "expo2015-lucia" "expo2015-roberto" "fast" "four-cables" "grab" "hrpcables"
    "ipanema-1" "ipanema-2" "ipanema-3" "irma4u" "macarm" "nist-robocrane" "segesta");

/// Cables (`cdpr-cable/1`), by name.
pub const CABLES: &[LibraryFile] = files!("cables":
    "dyneema-2.5mm" "dyneema-6mm" "expo2015" "steel-2mm" "steel-4mm" "steel-4mm-caroca" "steel-4mm-cogiro"
    "steel-6mm" "steel-46mm" "vectran-4mm");

/// The file of that name in [`ROBOTS`] or [`CABLES`].
pub fn named(library: &[LibraryFile], name: &str) -> Option<LibraryFile> {
    library.iter().find(|file| file.name == name).copied()
}

/// Names in a library that are similar to one that it does not have, the most similar one first.
pub fn near(library: &[LibraryFile], name: &str) -> Vec<&'static str> {
    let name = name.to_lowercase();
    let similarity = |of: &str| {
        let contained = of.contains(&name) || name.contains(of);
        if contained && !name.is_empty() { 1.0 } else { strsim::jaro_winkler(of, &name) }
    };
    let mut found: Vec<_> = library.iter().map(|file| (similarity(file.name), file.name)).collect();
    found.retain(|(similarity, _)| *similarity > SIMILAR);
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.into_iter().take(MOST_NEAR).map(|(_, name)| name).collect()
}

/// Similarity of Jaro and Winkler above which a name may be meant.
const SIMILAR: f64 = 0.75;

/// Names that are proposed at most.
const MOST_NEAR: usize = 4;
