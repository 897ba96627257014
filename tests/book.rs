//! The pages of the book: where their links lead, and which errors they explain.

use crate::data_files::{pages, root};

/// Kinds of errors that the sources of a file name: the words in functions `kind`, and in fields `kind`.
fn kinds(source: &str) -> Vec<String> {
    let words = |text: &str| {
        let words = text.split('"').skip(1).step_by(2).map(str::to_owned);
        words.filter(|word| word.bytes().all(|b| b == b'_' || b.is_ascii_lowercase())).collect::<Vec<_>>()
    };
    let functions = source.split("fn kind(").skip(1).filter_map(|rest| rest.split_once("&'static str {"));
    let functions = functions.filter_map(|(_, body)| body.split("\n    }\n").next());
    let fields = source.split("kind: \"").skip(1).filter_map(|rest| rest.split('"').next());
    functions.flat_map(words).chain(fields.map(str::to_owned)).collect()
}

#[test]
fn every_kind_of_error_has_an_entry_with_cause_and_remedy() {
    let page = std::fs::read_to_string(root().join("docs/how-to/errors.md")).unwrap();
    let mut all = vec!["beyond_limits".to_owned()];
    for crates in ["statics", "calibration", "python/src/convert"] {
        let (name, inner) = crates.split_once('/').unwrap_or((crates, "src"));
        let file = root().join(format!("crates/cdpr-{name}/{inner}/error.rs"));
        let found = kinds(&std::fs::read_to_string(&file).unwrap());
        assert!(!found.is_empty(), "{}", file.display());
        all.extend(found);
    }
    all.sort();
    all.dedup();
    assert!(all.len() >= 20, "{all:?}");
    for kind in &all {
        let entry = page.split(&format!("### `{kind}`\n")).nth(1);
        let entry = entry.unwrap_or_else(|| panic!("docs/how-to/errors.md has no entry of `{kind}`"));
        let entry = entry.split("\n##").next().unwrap();
        for part in ["*Cause.*", "*Remedy.*"] {
            assert!(entry.contains(part), "docs/how-to/errors.md: `{kind}` has no {part}");
        }
    }
    for entry in page.split("\n### `").skip(1).filter_map(|rest| rest.split('`').next()) {
        assert!(all.iter().any(|kind| kind == entry), "docs/how-to/errors.md: there is no kind `{entry}`");
    }
}

/// Whether a word of code in a page is a path of this repository, in full or from `crates`. A name in
/// capitals is one to fill in.
fn is_path(word: &str) -> bool {
    let folders = ["crates/", "data/", "docs/", "peers/", "xtask/"];
    let of_crate = word.starts_with("cdpr-") && (word.contains("/src") || word.contains("/tests"));
    let is_plain = word.chars().all(|c| c.is_ascii_alphanumeric() || "_-./".contains(c));
    let stem = word.rsplit('/').next().and_then(|name| name.split('.').next()).unwrap_or_default();
    let is_to_fill_in = !stem.is_empty() && stem.chars().all(|c| c.is_ascii_uppercase());
    (of_crate || folders.iter().any(|folder| word.starts_with(folder))) && is_plain && !is_to_fill_in
}

#[test]
fn paths_that_pages_name_exist() {
    let (mut count, mut all) = (0, Vec::new());
    pages(&root().canonicalize().unwrap(), &mut all);
    for page in all {
        let text = std::fs::read_to_string(&page).unwrap();
        let prose: String = text.split("```").step_by(2).collect();
        for word in prose.split('`').skip(1).step_by(2).filter(|word| is_path(word)) {
            let exists = root().join(word).exists() || root().join("crates").join(word).exists();
            assert!(exists, "{}: there is no {word}", page.display());
            count += 1;
        }
    }
    assert!(count > 100, "{count}");
}

/// The anchor that mdBook makes of a heading.
fn anchor(heading: &str) -> String {
    let heading = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[test]
fn links_lead_to_pages_and_to_headings() {
    let (mut count, mut all) = (0, Vec::new());
    let book = root().join("docs").canonicalize().unwrap();
    pages(&root().canonicalize().unwrap(), &mut all);
    for page in all {
        let text = std::fs::read_to_string(&page).unwrap();
        let prose: String = text.split("```").step_by(2).collect();
        for link in prose.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.starts_with("http") {
                continue;
            }
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            assert!(target.exists(), "{}: {link}", page.display());
            // mdBook copies nothing from outside of its folder, and calls a page README.md otherwise.
            let is_of_book =
                target.canonicalize().unwrap().starts_with(&book) && !target.ends_with("README.md");
            assert!(is_of_book || !page.starts_with(&book), "{}: {link} is not in the book", page.display());
            if !heading.is_empty() {
                let target = std::fs::read_to_string(&target).unwrap();
                let mut headings = target.lines().filter(|line| line.starts_with('#')).map(anchor);
                assert!(headings.any(|found| found == heading), "{}: {link}", page.display());
                count += 1;
            }
        }
    }
    assert!(count >= 20, "{count}");
}
