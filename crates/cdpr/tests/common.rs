//! The harness of all tests of the program: files of data, commands, and a folder with a robot and a study.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// Path of a file of the repository's `data`.
pub(crate) fn data(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(file)
}

/// The same as text, for an argument.
pub(crate) fn data_path(file: &str) -> String {
    data(file).to_str().unwrap().to_owned()
}

/// Text of a file of the repository's `data`.
pub(crate) fn data_text(file: &str) -> String {
    std::fs::read_to_string(data(file)).unwrap()
}

/// Content of a JSON file.
pub(crate) fn json_file(path: impl AsRef<Path>) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

/// `cdpr ...`.
pub(crate) fn cdpr(arguments: &[&str]) -> Output {
    cdpr_in(Path::new("."), arguments)
}

/// `cdpr ...` in a folder.
pub(crate) fn cdpr_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cdpr"));
    command.current_dir(folder).args(arguments).output().unwrap()
}

pub(crate) fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap()
}

/// What a command says on the standard error, with the lines that are wrapped at 80 columns joined.
pub(crate) fn unwrapped(bytes: Vec<u8>) -> String {
    let said = text(bytes);
    let mut joined: Vec<String> = Vec::new();
    for line in said.lines() {
        let indent = line.len() - line.trim_start().len();
        match joined.last_mut() {
            Some(before) if [2, 6].contains(&indent) && !before.is_empty() => {
                before.push(' ');
                before.push_str(line.trim_start());
            }
            _ => joined.push(line.to_owned()),
        }
    }
    let end = if said.ends_with('\n') { "\n" } else { "" };
    joined.join("\n") + end
}

/// Standard output of a command that must succeed and say nothing on the standard error but how long it takes
/// and that all poses of a table are held.
pub(crate) fn answered(output: Output) -> String {
    let said = unwrapped(output.stderr);
    let is_well = |line: &str| is_progress(line) || is_all_held(line);
    assert!(output.status.success() && said.lines().all(is_well), "{said}");
    text(output.stdout)
}

/// Whether a line says that all poses of a table are held: `3 of 3 poses held, ...`.
pub(crate) fn is_all_held(line: &str) -> bool {
    let held = line.split_once(" of ").and_then(|(held, rest)| {
        let (poses, rest) = rest.split_once(' ')?;
        Some(held == poses && (rest.starts_with("pose held") || rest.starts_with("poses held")))
    });
    held == Some(true)
}

/// Whether a line says how long a command takes so far.
pub(crate) fn is_progress(line: &str) -> bool {
    let seconds = line.rsplit_once(", ").and_then(|(_, time)| time.strip_suffix(" s"));
    seconds.is_some_and(|seconds| seconds.parse::<u64>().is_ok())
}

/// Files by their names.
pub(crate) type Files = BTreeMap<String, Vec<u8>>;

/// A folder with a robot, `robot.json`, and a study, `study.json`.
pub(crate) struct Bench {
    folder: TempDir,
}

impl Bench {
    /// With CAROCA and a study of `data/studies` as `change` makes it.
    pub(crate) fn new(study: &str, change: impl FnOnce(&mut Value)) -> Self {
        let bench = Self { folder: TempDir::new().unwrap() };
        bench.write("robot.json", &json_file(data("robots/caroca.json")));
        bench.write("study.json", &json_file(data("studies").join(study)));
        bench.change("study.json", |study| {
            study["robot"] = json!("robot.json");
            study["bootstrap_resamples"] = json!(2);
            change(study);
        });
        bench
    }

    /// Changes the content of a JSON file.
    pub(crate) fn change(&self, file: &str, change: impl FnOnce(&mut Value)) {
        let mut content = self.json(file);
        change(&mut content);
        self.write(file, &content);
    }

    /// Writes a JSON file with indents: errors in it have lines.
    fn write(&self, file: &str, content: &Value) {
        std::fs::write(self.path(file), format!("{content:#}")).unwrap();
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A program in the folder, on its own: no launcher and no scheduler.
    pub(crate) fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.current_dir(self.folder.path());
        let launchers =
            ["SLURM_ARRAY_TASK_ID", "HQ_TASK_ID", "OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"];
        launchers.iter().for_each(|variable| {
            command.env_remove(variable);
        });
        command
    }

    /// `cdpr study ...` in the folder, not yet started.
    pub(crate) fn study_command(&self, arguments: &[&str]) -> Command {
        let mut command = self.command(env!("CARGO_BIN_EXE_cdpr"));
        command.arg("study").args(arguments);
        command
    }

    /// `cdpr study ...` in the folder.
    pub(crate) fn study(&self, arguments: &[&str]) -> Output {
        self.study_command(arguments).output().unwrap()
    }

    /// Both outputs of a command that must succeed.
    pub(crate) fn done(&self, arguments: &[&str]) -> String {
        let output = self.study(arguments);
        let text = text(output.stdout) + &unwrapped(output.stderr);
        assert!(output.status.success(), "{arguments:?}: {text}");
        text
    }

    /// Both outputs of a run into the folder `out`, which must succeed.
    pub(crate) fn run(&self, out: &str, arguments: &[&str]) -> String {
        self.done(&[&["run", "study.json", "--out", out], arguments].concat())
    }

    /// Message of a command that must fail with code 1.
    pub(crate) fn refused(&self, arguments: &[&str]) -> String {
        self.failed(1, arguments)
    }

    /// Message of a command that must fail with code 2: the arguments are wrong.
    pub(crate) fn misused(&self, arguments: &[&str]) -> String {
        self.failed(2, arguments)
    }

    fn failed(&self, code: i32, arguments: &[&str]) -> String {
        let output = self.study(arguments);
        let text = unwrapped(output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {text}");
        assert!(!text.contains("panicked"), "{text}");
        text
    }

    /// All files of a folder of results, blocks included; without times and the report, which contains times.
    pub(crate) fn files(&self, out: &str) -> Files {
        let root = self.path(out);
        let (mut folders, mut files) = (vec![root.clone()], Files::new());
        while let Some(folder) = folders.pop() {
            for path in std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
                if path.is_dir() {
                    folders.push(path);
                } else {
                    let name = path.strip_prefix(&root).unwrap().display().to_string();
                    files.insert(name, std::fs::read(&path).unwrap());
                }
            }
        }
        files.retain(|name, _| !["timings.json", "report.html"].contains(&name.as_str()));
        files
    }

    /// The files without those in folders, such as blocks.
    pub(crate) fn results(&self, out: &str) -> Files {
        let mut files = self.files(out);
        files.retain(|name, _| !name.contains('/'));
        files
    }

    /// Checks that two folders hold the same files.
    pub(crate) fn assert_same(&self, one: &str, other: &str) {
        assert_same_files(&self.files(one), &self.files(other));
    }

    /// Content of a JSON file in the folder.
    pub(crate) fn json(&self, file: &str) -> Value {
        json_file(self.path(file))
    }
}

/// Checks that two folders hold the same files, a summary among them.
pub(crate) fn assert_same_files(one: &Files, other: &Files) {
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    assert!(one.contains_key("summary.json"));
    for (name, text) in one {
        assert!(*text == other[name], "{name} differs");
    }
}
