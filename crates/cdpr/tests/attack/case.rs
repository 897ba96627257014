//! One case of the attack.

/// Folder of results, the only one in which a case may write.
pub(super) const OUT: &str = "out";
/// Content of files that are the user's own, also in the folder of results.
pub(super) const MINE: &[u8] = b"mine";

/// Something to run in the folder of all cases.
#[derive(Default)]
pub(super) struct Case {
    /// What is wrong.
    pub(super) what: String,
    /// Files that are written before, and removed after the case.
    pub(super) files: Vec<(String, Vec<u8>)>,
    /// A command of the shell that prepares what no file can be.
    pub(super) shell: Option<String>,
    /// Arguments of the program. The character U+FFFD stands for a byte that is not UTF-8.
    pub(super) arguments: Vec<String>,
    /// How the shell runs the program, `"$0" "$@"`, if not simply so.
    pub(super) around: &'static str,
    /// Whether an answer is possible, too: a bad value may be harmless.
    pub(super) may_succeed: bool,
}

/// The words of a command.
pub(super) fn split(command: &str) -> Vec<String> {
    command.split(' ').map(str::to_owned).collect()
}
