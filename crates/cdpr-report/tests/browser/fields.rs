//! The explorer under real keys: its fields, numbers and address are of one state.

use crate::common::data;
use crate::explorer::write_page;
use crate::page::{Page, chromium};
use cdpr_web::Live;
use serde_json::{Value, json};

/// What the page shows: its field of z, the address, the beginning of its numbers.
const SHOWN: &str = r#"(() => {
  const hash = location.hash.split("state=")[1] ?? "";
  const saved = hash ? JSON.parse(atob(hash.replaceAll("-", "+").replaceAll("_", "/"))) : {};
  const { input, note } = field("z");
  return {
    text: input.value, draft: input.classList.contains("draft"), note: note.textContent,
    position: saved.position ?? null, numbers: document.querySelector(".numbers").textContent,
  };
})()"#;

/// Finds a field by its label, and gives it the focus with all its text selected.
const FIELD: &str = r#"
  window.field = (name) => {
    const named = (one) => one.textContent.startsWith(`${name} `);
    const all = [...document.querySelectorAll(".field"), ...document.querySelectorAll(".slider")];
    const one = all.find(named);
    return { input: one.querySelector("input:not([type=range])"), note: one.querySelector(".fieldnote") };
  };
  window.enter = (name) => { const { input } = field(name); input.focus(); input.select(); };"#;

/// The explorer of CAROCA with its first numbers, and the deflection of the native model at a height [mm].
pub(crate) fn caroca() -> (Page, impl FnMut(f64) -> String) {
    let robot = data("robots/caroca.json");
    let file = write_page("caroca-fields", &robot);
    let mut page = Page::open(chromium());
    page.surround(1400, "dark");
    page.show(&file);
    page.wait_for("document.querySelector('#explorer .numbers')?.textContent.includes('mm')");
    page.evaluate(FIELD);
    let mut live = Live::new(&robot.to_string()).unwrap();
    let deflection = move |z: f64| {
        let ask = json!({"hold": {"pose": [0, 0, z, 1, 0, 0, 0], "load": {"payload": 18}}});
        let answer: Value = serde_json::from_str(&live.ask(&ask.to_string())).unwrap();
        let deflection = 1e3 * answer["ok"]["rms"].as_f64().unwrap();
        // Four digits, as the page has them.
        format!("{deflection:.*} mm", if deflection < 1.0 { 4 } else { 3 })
    };
    (page, deflection)
}

/// Waits until field, address and numbers are of this height.
fn shows(page: &mut Page, z: f64, deflection: &str) {
    // The address leaves out what is as it was first.
    let position = if z == 1.75 { Value::Null } else { json!([0, 0, z]) };
    page.wait_for(&format!(
        "(of => of.numbers.startsWith('deflection{deflection}') \
         && JSON.stringify(of.position ?? null) === '{position}')({SHOWN})"
    ));
    let shown = page.evaluate(SHOWN);
    assert_eq!(shown["text"], json!(z.to_string()), "{shown}");
    assert_eq!(shown["draft"], json!(false), "{shown}");
    assert_eq!(shown["position"], position, "{shown}");
}

#[test]
fn fields_numbers_and_address_follow_one_stack_of_undo() {
    let (mut page, mut deflection) = caroca();
    shows(&mut page, 1.75, &deflection(1.75));
    page.evaluate("enter('z')");
    page.write("2.5");
    page.press("Enter", 0);
    shows(&mut page, 2.5, &deflection(2.5));
    // In the field that was typed in, the browser would take back the text alone.
    page.press("z", 2);
    shows(&mut page, 1.75, &deflection(1.75));
    page.press("y", 2);
    shows(&mut page, 2.5, &deflection(2.5));
    for key in ["Escape", "z"] {
        page.evaluate("enter('z')");
        page.write("9.1");
        let shown = page.evaluate(SHOWN);
        assert_eq!((&shown["text"], &shown["draft"]), (&json!("9.1"), &json!(true)), "{shown}");
        assert_eq!(shown["note"], "Enter computes it, Escape takes it back.");
        page.press(key, if key == "z" { 2 } else { 0 });
        shows(&mut page, 2.5, &deflection(2.5));
    }
    // A list that has the focus follows, too.
    page.evaluate(
        "(() => { const list = document.querySelector('.side select'); list.focus(); list.value = 'mid'; \
         list.dispatchEvent(new Event('change')); })()",
    );
    page.press("z", 2);
    page.wait_for("document.querySelector('.side select').value === 'norm'");
    shows(&mut page, 2.5, &deflection(2.5));
}

#[test]
fn a_decimal_comma_is_read_and_what_is_no_number_is_told() {
    let (mut page, mut deflection) = caroca();
    page.evaluate("enter('z')");
    page.write("1,7");
    page.press("Enter", 0);
    shows(&mut page, 1.7, &deflection(1.7));
    for (typed, words) in
        [("abc", "“abc” is not a number"), ("-5", "The least value is 0: the ground is there")]
    {
        page.evaluate("enter('z')");
        page.write(typed);
        page.press("Enter", 0);
        let shown = page.evaluate(SHOWN);
        let note = shown["note"].as_str().unwrap();
        assert!(note.starts_with(words) && note.ends_with("1.7 is computed."), "{shown}");
        assert_eq!(shown["position"], json!([0, 0, 1.7]), "{shown}");
        page.press("Escape", 0);
        shows(&mut page, 1.7, &deflection(1.7));
    }
}

#[test]
fn observations_are_of_the_force_and_the_lengths_on_screen_or_hidden_with_the_reason() {
    let (mut page, _) = caroca();
    let words = "[...document.querySelectorAll('.charts .says')].map((said) => said.textContent).join(' ')";
    let current = "!document.querySelector('.charts').classList.contains('stale')";
    let hidden = "document.querySelector('.charts .pair').hidden";
    let seen = format!("{current} && !{hidden} && /^Mean deflection .* matters/.test({words})");
    let other_than = |before: &Value| format!("{seen} && {words} !== {before}");
    page.wait_for(&seen);
    let of_payload = page.evaluate(words);
    page.evaluate("enter('force x')");
    page.write("100");
    page.press("Enter", 0);
    page.wait_for(&other_than(&of_payload));
    let of_force = page.evaluate(words);
    page.evaluate("document.querySelector('.stagebar input[value=kept]').click()");
    page.wait_for(&other_than(&of_force));
    page.evaluate("enter('force x')");
    page.write("0");
    page.press("Enter", 0);
    page.evaluate("enter('payload')");
    page.write("0");
    page.press("Enter", 0);
    let failure = "document.querySelector('.charts .failure')";
    page.wait_for(&format!("{hidden} && !{failure}.hidden && {failure}.textContent.includes('no load')"));
    let said = page.evaluate(words);
    assert_eq!(said.as_str().map(str::trim), Some(""));
}
