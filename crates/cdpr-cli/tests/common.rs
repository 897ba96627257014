//! A folder with a robot and a study to run in it.

// Each test uses a part of it.
#![allow(dead_code)]

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// A file of the repository's `data`.
pub(crate) fn data(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(file)
}

pub(crate) struct Bench {
    folder: TempDir,
}

impl Bench {
    /// With a study of `data/studies` as `change` makes it.
    pub(crate) fn new(study: &str, change: impl FnOnce(&mut Value)) -> Self {
        let bench = Self { folder: TempDir::new().unwrap() };
        std::fs::copy(data("robots/caroca.json"), bench.path("robot.json")).unwrap();
        let text = std::fs::read_to_string(data("studies").join(study)).unwrap();
        let mut study: Value = serde_json::from_str(&text).unwrap();
        study["robot"] = json!("robot.json");
        study["bootstrap_resamples"] = json!(2);
        change(&mut study);
        // Indented: what is wrong is said with its line.
        std::fs::write(bench.path("study.json"), format!("{study:#}")).unwrap();
        bench
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// `cdpr study ...`, or another program in the folder, on its own: no launcher and no scheduler.
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

    pub(crate) fn study(&self, arguments: &[&str]) -> Output {
        self.command(env!("CARGO_BIN_EXE_cdpr")).arg("study").args(arguments).output().unwrap()
    }

    /// Both outputs of a command that must succeed.
    pub(crate) fn done(&self, arguments: &[&str]) -> String {
        let output = self.study(arguments);
        let text = [output.stdout, output.stderr].concat();
        let text = String::from_utf8(text).unwrap();
        assert!(output.status.success(), "{arguments:?}: {text}");
        text
    }

    pub(crate) fn run(&self, out: &str, arguments: &[&str]) -> String {
        self.done(&[&["run", "study.json", "--out", out], arguments].concat())
    }

    /// Message of a command that must fail with code 1.
    pub(crate) fn refused(&self, arguments: &[&str]) -> String {
        let output = self.study(arguments);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {text}");
        text
    }

    /// All files of a folder of results with their contents, blocks included; but for times and the report, in which they stand, too.
    pub(crate) fn files(&self, out: &str) -> BTreeMap<String, Vec<u8>> {
        let root = self.path(out);
        let (mut folders, mut files) = (vec![root.clone()], BTreeMap::new());
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

    pub(crate) fn assert_same(&self, one: &str, other: &str) {
        let [one, other] = [one, other].map(|out| self.files(out));
        assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
        assert!(one.contains_key("summary.json"));
        for (name, text) in &one {
            assert!(*text == other[name], "{name} differs");
        }
    }

    pub(crate) fn json(&self, file: &str) -> Value {
        serde_json::from_slice(&std::fs::read(self.path(file)).unwrap()).unwrap()
    }
}
