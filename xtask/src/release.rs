//! `cargo xtask release`: sets the repository, the authors and the version wherever files name them.
//!
//! All files are changed in memory first: where a value is bad, or a place is missing, none is written.

use crate::cargo::{Outcome, cargo_command, done, printed, read, root, write};
use clap::Args;
use semver::Version;
use std::collections::BTreeMap;

/// Files that name the repository.
const WITH_REPOSITORY: [&str; 6] = ["Cargo.toml", CITATION, "README.md", PYTHON, "docs/book.toml", RECIPE];
const CITATION: &str = "CITATION.cff";
const PYTHON: &str = "crates/cdpr-python/pyproject.toml";
const RECIPE: &str = "recipe/recipe.yaml";
/// Manifest of the package for ROS.
const ROS: &str = "crates/cdpr-c/ros2/cdpr_ros/package.xml";

/// Heading of what comes with the next version.
const UNRELEASED: &str = "\n## Unreleased\n";

/// What to set; the rest stays as it is.
#[derive(Args)]
#[group(required = true, multiple = true)]
pub(crate) struct Values {
    /// Address of the repository, https://HOST/OWNER/cdpr
    #[arg(long, value_name = "URL", value_parser = repository)]
    repository: Option<String>,
    /// Authors, as `NAME <MAIL>, NAME <MAIL>`
    #[arg(long, value_name = "AUTHORS", value_delimiter = ',', value_parser = author)]
    authors: Vec<Author>,
    /// Version, such as 0.1.0 or 0.2.0-rc.1
    #[arg(long, value_name = "X.Y.Z", value_parser = version)]
    version: Option<Version>,
    /// DOI of the software in an archive, such as 10.5281/zenodo.1234567
    #[arg(long, value_name = "DOI", value_parser = doi)]
    doi: Option<String>,
}

#[derive(Clone)]
struct Author {
    given: String,
    family: String,
    mail: String,
}

/// Texts of files by their path in the repository.
type Files = BTreeMap<&'static str, String>;

pub(crate) fn run(values: &Values) -> Outcome {
    let today = printed("date", &["-u", "+%F"])?;
    let files = changed(values, &today, |file| read(&root().join(file)))?;
    for (file, text) in &files {
        write(&root().join(file), text)?;
        eprintln!("written: {file}");
    }
    // The lock file has the versions of the workspace's own packages.
    done(&mut cargo_command(&["update", "--workspace", "--offline", "--quiet"]))
}

fn repository(value: &str) -> Result<String, String> {
    let parts: Vec<&str> = value.strip_prefix("https://").unwrap_or_default().split('/').collect();
    let is_plain = |part: &&str| {
        !part.is_empty() && part.chars().all(|c| c.is_ascii_alphanumeric() || "-_.~".contains(c))
    };
    let is_address = parts.len() >= 2 && parts.iter().all(is_plain) && !value.ends_with(".git");
    let expected = "expected an address https://HOST/OWNER/cdpr without a slash at its end";
    is_address.then(|| value.to_owned()).ok_or_else(|| expected.to_owned())
}

fn author(value: &str) -> Result<Author, String> {
    let parts = || {
        let (name, rest) = value.trim().split_once(" <")?;
        let mail = rest.strip_suffix('>')?;
        let (given, family) = name.trim().rsplit_once(' ')?;
        let (user, host) = mail.split_once('@')?;
        let is_mail =
            !user.is_empty() && host.contains('.') && !host.contains('@') && !mail.contains([' ', '"']);
        let is_name = !name.contains(['"', '\'', '\\', '<', '>', ':', '[', '{', '#', '\n']);
        let [given, family, mail] = [given, family, mail].map(str::to_owned);
        (is_mail && is_name).then_some(Author { given, family, mail })
    };
    let expected = "expected `GIVEN NAMES FAMILY NAME <MAIL>`, several with a comma between them";
    parts().ok_or_else(|| expected.to_owned())
}

fn version(value: &str) -> Result<Version, String> {
    let version = Version::parse(value).ok().filter(|version| version.build.is_empty());
    version.ok_or_else(|| {
        "expected three numbers, such as 0.1.0, and perhaps a pre-release, 0.2.0-rc.1".to_owned()
    })
}

fn doi(value: &str) -> Result<String, String> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-._;()/".contains(c);
    let parts = value.split_once('/').filter(|(prefix, name)| prefix.starts_with("10.") && !name.is_empty());
    let is_doi = parts.is_some() && value.chars().all(is_plain);
    let expected = "expected a DOI without its address, such as 10.5281/zenodo.1234567";
    is_doi.then(|| value.to_owned()).ok_or_else(|| expected.to_owned())
}

/// The files that differ with these values.
fn changed(values: &Values, today: &str, open: impl Fn(&'static str) -> Outcome<String>) -> Outcome<Files> {
    let manifest = open("Cargo.toml")?;
    // A file, the texts before and after the value, and the value.
    let mut edits: Vec<(&'static str, &str, &str, String)> = Vec::new();
    if !values.authors.is_empty() {
        let list = |each: &dyn Fn(&str, &Author) -> String, separator: &str| {
            let each = |of: &Author| each(&format!("{} {}", of.given, of.family), of);
            values.authors.iter().map(each).collect::<Vec<_>>().join(separator)
        };
        let cargo = list(&|name, of| format!("\"{name} <{}>\"", of.mail), ", ");
        let python = list(&|name, of| format!("{{ name = \"{name}\", email = \"{}\" }}", of.mail), ", ");
        let cited = |_: &str, Author { given, family, mail }: &Author| {
            format!("  - family-names: {family}\n    given-names: {given}\n    email: {mail}\n")
        };
        let ros = |name: &str, of: &Author| format!(" email=\"{}\">{name}</maintainer>", of.mail);
        let paper = |name: &str, _: &Author| format!("  - name: {name}\n    affiliation: 1\n");
        edits.extend([
            ("Cargo.toml", "\nauthors = [", "]\n", cargo),
            (PYTHON, "\nauthors = [", "]\n", python),
            (CITATION, "\nauthors:\n", "license:", list(&cited, "")),
            (ROS, "\n  <maintainer", "\n  <license>", list(&ros, "\n  <maintainer")),
            ("docs/joss/paper.md", "\nauthors:\n", "affiliations:", list(&paper, "")),
        ]);
    }
    if let Some(new) = &values.version {
        // ROS has versions of three numbers alone.
        let numbers = format!("{}.{}.{}", new.major, new.minor, new.patch);
        edits.extend([
            // With the date, which is there once a version is released.
            (CITATION, "\nversion: ", "\nrepository-code: ", format!("{new}\ndate-released: {today}")),
            (RECIPE, "version: \"", "\"", new.to_string()),
            (ROS, "\n  <version>", "</version>", numbers),
        ]);
    }
    if let Some(doi) = &values.doi {
        edits.push((CITATION, "\ntype: software\n", "version: ", format!("doi: {doi}\n")));
    }
    let mut files = Files::new();
    let mut edit = |file: &'static str, what: &str, change: &dyn Fn(&str) -> Option<String>| -> Outcome {
        let text = files.get(file).cloned().map_or_else(|| open(file), Ok)?;
        files.insert(file, change(&text).ok_or_else(|| format!("{file} has no {what}"))?);
        Ok(())
    };
    if let Some(new) = &values.repository {
        let old = between(&manifest, "\nrepository = \"", "\"").ok_or("Cargo.toml has no repository")?;
        for file in WITH_REPOSITORY {
            edit(file, old, &|text| text.contains(old).then(|| text.replace(old, new)))?;
        }
    }
    for (file, begin, end, value) in &edits {
        edit(file, begin.trim(), &|text| set(text, begin, end, value))?;
    }
    if let Some(new) = &values.version {
        let old = between(&manifest, "\nversion = \"", "\"").ok_or("Cargo.toml has no version")?;
        let [old, version] = [old, &new.to_string()].map(|version| format!("version = \"{version}\""));
        let line = |line: &str| match line.starts_with("version = ") || line.starts_with("cdpr") {
            true => line.replace(&old, &version) + "\n",
            false => format!("{line}\n"),
        };
        edit("Cargo.toml", "version", &|text| Some(text.lines().map(line).collect()))?;
        let heading = format!("\n## {new} ({today})\n");
        edit("CHANGELOG.md", "section Unreleased", &|text| {
            text.contains(UNRELEASED).then(|| text.replacen(UNRELEASED, &heading, 1))
        })?;
    }
    Ok(files)
}

/// What stands between two texts, the first time.
fn between<'a>(text: &'a str, begin: &str, end: &str) -> Option<&'a str> {
    text.split_once(begin)?.1.split_once(end).map(|(found, _)| found)
}

/// A text with another value between two texts, the first time.
fn set(text: &str, begin: &str, end: &str, value: &str) -> Option<String> {
    let (before, rest) = text.split_once(begin)?;
    let at = rest.find(end)?;
    Some(format!("{before}{begin}{value}{}", &rest[at..]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        values: Values,
    }

    fn parsed(arguments: &[&str]) -> Result<Values, String> {
        let line = Line::try_parse_from([&["release"], arguments].concat());
        line.map(|line| line.values).map_err(|error| error.to_string())
    }

    #[test]
    fn every_place_of_this_repository_is_set_and_can_be_set_again() {
        let first = parsed(&[
            "--repository",
            "https://example.net/ropes/cdpr",
            "--authors",
            "Ada King <ada@example.net>, Grace Brewster Hopper <grace@example.net>",
            "--version",
            "3.1.4-rc.1",
            "--doi",
            "10.5281/zenodo.1",
        ]);
        let files = changed(&first.unwrap(), "2030-01-02", |file| read(&root().join(file))).unwrap();
        let has = |file: &str, text: &str| assert!(files[file].contains(text), "{file}: {}", files[file]);
        for file in WITH_REPOSITORY {
            has(file, "https://example.net/ropes/cdpr");
        }
        has("Cargo.toml", "authors = [\"Ada King <ada@example.net>\", \"Grace Brewster Hopper <");
        has("Cargo.toml", "\nversion = \"3.1.4-rc.1\"\n");
        has("Cargo.toml", "cdpr-web = { path = \"crates/cdpr-web\", version = \"3.1.4-rc.1\" }");
        has("CITATION.cff", "  - family-names: Hopper\n    given-names: Grace Brewster\n    email: grace@");
        has("CITATION.cff", "type: software\ndoi: 10.5281/zenodo.1\nversion: 3.1.4-rc.1\n");
        has("CITATION.cff", "version: 3.1.4-rc.1\ndate-released: 2030-01-02\nrepository-code: ");
        has("crates/cdpr-python/pyproject.toml", "{ name = \"Ada King\", email = \"ada@example.net\" }");
        has("docs/joss/paper.md", "  - name: Ada King\n    affiliation: 1\n  - name: Grace");
        has("recipe/recipe.yaml", "version: \"3.1.4-rc.1\"");
        has(ROS, "<version>3.1.4</version>");
        has(ROS, "<maintainer email=\"grace@example.net\">Grace Brewster Hopper</maintainer>\n  <license>");
        has("CHANGELOG.md", "\n## 3.1.4-rc.1 (2030-01-02)\n");
        let second = parsed(&["--repository", "https://example.net/b", "--authors", "B C <b@c.de>"]).unwrap();
        let again = changed(&second, "2030-01-03", |file| Ok(files[file].clone())).unwrap();
        assert!(again.values().all(|text| !text.contains("example.net/ropes") && !text.contains("Ada")));
        assert!(again["Cargo.toml"].contains("authors = [\"B C <b@c.de>\"]\n"));
    }

    #[test]
    fn bad_values_are_refused_by_the_name_of_their_field() {
        let refused = |option: &str, values: &[&str]| {
            for value in values {
                let error = parsed(&[option, value]).err().unwrap_or_else(|| panic!("{option} {value:?}"));
                assert!(error.contains(option) && error.contains("expected"), "{error}");
            }
        };
        refused(
            "--repository",
            &["", "cdpr", "http://a.de/b", "https://a.de", "https://a.de/b/", "https://a.de/b\"c"],
        );
        refused(
            "--authors",
            &["", "Ada", "Ada King", "Ada King <ada>", "Ada King <ada@home>", "A \"B <a@b.de>"],
        );
        refused(
            "--version",
            &["", "1", "1.2", "1.2.3.4", "v1.2.3", "1.02.3", "1.2.3-", "1.2.3-a b", "1.2.3+4"],
        );
        refused(
            "--doi",
            &["", "zenodo.1", "10.5281", "10.5281/", "https://doi.org/10.5281/zenodo.1", "10.1/a b"],
        );
        assert!(parsed(&["--version"]).is_err() && parsed(&[]).is_err() && parsed(&["--name", "a"]).is_err());
    }
}
