//! Sizes of files and functions, and the numbers of parameters.

use syn::visit_mut::{self, VisitMut};
use syn::{Attribute, ImplItemFn, ItemFn, ItemImpl, Signature, TraitItemFn};

/// Lines of a file at most.
const LONGEST_FILE: usize = 400;

/// Lines of a function at most, from `fn` to its closing brace.
const LONGEST_FUNCTION: usize = 80;

/// Parameters of a function at most.
const MOST_PARAMETERS: usize = 6;

/// What is too long in a file, and functions with too many parameters.
pub(crate) fn excesses(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let lines: Vec<&str> = text.lines().collect();
    if lines.len() > LONGEST_FILE {
        found.push(format!("{} lines, expected at most {LONGEST_FILE}", lines.len()));
    }
    let long = functions(&lines).filter(|(_, length)| *length > LONGEST_FUNCTION);
    found.extend(
        long.map(|(name, length)| format!("{name} has {length} lines, expected at most {LONGEST_FUNCTION}")),
    );
    let mut parameters = Parameters::default();
    parameters.visit_file_mut(&mut syn::parse_file(text).unwrap());
    let many = parameters.0.into_iter().filter(|(_, count)| *count > MOST_PARAMETERS);
    found.extend(
        many.map(|(name, count)| {
            format!("{name} has {count} parameters, expected at most {MOST_PARAMETERS}")
        }),
    );
    found
}

/// Name and lines of each function with a body. rustfmt puts its closing brace below the line of its `fn`.
fn functions<'a>(lines: &'a [&'a str]) -> impl Iterator<Item = (&'a str, usize)> {
    lines.iter().enumerate().filter_map(|(first, line)| {
        let code = line.trim_start();
        let qualifiers =
            ["pub ", "pub(crate) ", "pub(super) ", "const ", "unsafe ", "async ", "extern \"C\" "];
        let mut rest = code;
        while let Some(next) = qualifiers.iter().find_map(|word| rest.strip_prefix(word)) {
            rest = next;
        }
        let name =
            rest.strip_prefix("fn ")?.split(|sign: char| !sign.is_alphanumeric() && sign != '_').next()?;
        let indented = &line[..line.len() - code.len()];
        let ends = |line: &&str| line.strip_prefix(indented).is_some_and(|end| end == "}");
        let is_short = line.ends_with('}') || line.ends_with(';');
        let more = if is_short { 0 } else { lines[first..].iter().position(ends)? };
        Some((name, more + 1))
    })
}

/// The number of parameters of each function, receivers included. Those of a function that Python calls are
/// the keywords of its arguments: they are not counted.
#[derive(Default)]
struct Parameters(Vec<(String, usize)>);

impl Parameters {
    fn count(&mut self, signature: &Signature) {
        self.0.push((signature.ident.to_string(), signature.inputs.len()));
    }
}

fn has(attributes: &[Attribute], name: &str) -> bool {
    attributes.iter().any(|attribute| attribute.path().is_ident(name))
}

impl VisitMut for Parameters {
    fn visit_item_fn_mut(&mut self, item: &mut ItemFn) {
        if !has(&item.attrs, "pyfunction") {
            self.count(&item.sig);
        }
        visit_mut::visit_item_fn_mut(self, item);
    }

    fn visit_item_impl_mut(&mut self, item: &mut ItemImpl) {
        if !has(&item.attrs, "pymethods") {
            visit_mut::visit_item_impl_mut(self, item);
        }
    }

    fn visit_impl_item_fn_mut(&mut self, item: &mut ImplItemFn) {
        self.count(&item.sig);
        visit_mut::visit_impl_item_fn_mut(self, item);
    }

    fn visit_trait_item_fn_mut(&mut self, item: &mut TraitItemFn) {
        self.count(&item.sig);
        visit_mut::visit_trait_item_fn_mut(self, item);
    }
}

#[test]
fn a_long_function_and_one_with_many_parameters_are_excesses() {
    let long =
        format!("impl A {{\n    pub(crate) fn long() {{\n{}    }}\n}}\n", "        work();\n".repeat(79));
    assert_eq!(excesses(&long), ["long has 81 lines, expected at most 80"]);
    assert!(excesses(&long.replacen("        work();\n", "", 1)).is_empty());
    let many = "trait A {\n    fn many(&self, a: A, b: B, c: C, d: D, e: E, f: F);\n}\n";
    assert_eq!(excesses(many), ["many has 7 parameters, expected at most 6"]);
    assert!(excesses(&many.replace(", f: F", "")).is_empty());
    let python = "#[pymethods]\nimpl A {\n    fn many(&self, a: A, b: B, c: C, d: D, e: E, f: F) {}\n}\n";
    assert!(excesses(python).is_empty() && !excesses(&python.replace("#[pymethods]", "")).is_empty());
    assert_eq!(excesses(&"// A line.\n".repeat(401)), ["401 lines, expected at most 400"]);
}
