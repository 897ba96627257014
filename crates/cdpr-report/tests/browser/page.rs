//! A page in Chromium without a window, driven over its debugging socket (Chrome DevTools Protocol).

use base64::Engine;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use tungstenite::{Message, WebSocket};

/// Height of the window [px].
const HEIGHT: u32 = 3000;

const ALL_NEAR_ARE_DRAWN: &str = "[...document.querySelectorAll('.plot:not([hidden])')].every((plot) => { \
     const { top, bottom } = plot.getBoundingClientRect(); \
     return bottom < 0 || top > innerHeight || plot.dataset.drawn; })";

/// The first of the programs that a system may have.
pub(crate) fn chromium() -> &'static str {
    let is_installed = |name: &&str| {
        let version =
            Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        version.is_ok_and(|status| status.success())
    };
    let installed = ["chromium", "chromium-browser", "google-chrome"].into_iter().find(is_installed);
    installed.expect("Chromium has to be installed for this test")
}

/// A page in a browser.
pub(crate) struct Page {
    process: Child,
    socket: WebSocket<TcpStream>,
    session: Option<String>,
    calls: u64,
    /// What the browser said unasked.
    pub(crate) events: Vec<Value>,
    _profile: tempfile::TempDir,
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Page {
    pub(crate) fn open(program: &str) -> Self {
        let profile = tempfile::TempDir::new().unwrap();
        let mut process = Command::new(program)
            .args([
                "--headless=new",
                "--no-sandbox",
                "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader",
            ])
            .args([
                "--no-first-run",
                "--hide-scrollbars",
                "--disable-dev-shm-usage",
                "--remote-debugging-port=0",
            ])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(process.stderr.take().unwrap()).lines();
        let address = lines
            .find_map(|line| line.unwrap().strip_prefix("DevTools listening on ").map(str::to_owned))
            .unwrap();
        // The rest of what it says is read, lest it wait for a reader.
        std::thread::spawn(move || lines.for_each(drop));
        let host = address.strip_prefix("ws://").unwrap().split('/').next().unwrap();
        let stream = TcpStream::connect(host).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(600))).unwrap();
        let (socket, _) = tungstenite::client(address.as_str(), stream).unwrap();
        let mut page =
            Self { process, socket, session: None, calls: 0, events: Vec::new(), _profile: profile };
        let target = page.call("Target.createTarget", json!({"url": "about:blank"}))["targetId"].clone();
        let attached = page.call("Target.attachToTarget", json!({"targetId": target, "flatten": true}));
        page.session = Some(attached["sessionId"].as_str().unwrap().to_owned());
        for domain in ["Page", "Runtime", "Network", "Log"] {
            page.call(&format!("{domain}.enable"), json!({}));
        }
        page
    }

    /// Calls a method of the browser; its answer.
    pub(crate) fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.calls += 1;
        let mut call = json!({"id": self.calls, "method": method, "params": parameters});
        if let Some(session) = &self.session {
            call["sessionId"] = json!(session);
        }
        self.socket.send(Message::text(call.to_string())).unwrap();
        loop {
            let message = self.socket.read().unwrap();
            let Message::Text(text) = message else { continue };
            let answer: Value = serde_json::from_str(&text).unwrap();
            if answer["id"] == self.calls {
                assert!(answer.get("error").is_none(), "{method}: {answer}");
                return answer["result"].clone();
            }
            self.events.push(answer);
        }
    }

    /// The value of an expression in the page, waited for if it is a promise.
    pub(crate) fn evaluate(&mut self, expression: &str) -> Value {
        let parameters = json!({"expression": expression, "awaitPromise": true, "returnByValue": true});
        let answer = self.call("Runtime.evaluate", parameters);
        assert!(answer.get("exceptionDetails").is_none(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// Waits until a condition of the page holds.
    pub(crate) fn wait_for(&mut self, condition: &str) {
        let held = self.evaluate(&format!(
            "new Promise((done) => {{ const end = Date.now() + 30000; \
             const look = () => ({condition}) ? done(true) \
             : Date.now() > end ? done(false) : setTimeout(look, 30); look(); }})"
        ));
        assert_eq!(held, true, "{condition}");
    }

    /// Opens a file.
    pub(crate) fn show(&mut self, file: &Path) {
        self.call("Page.navigate", json!({"url": format!("file://{}", file.display())}));
        self.wait_for("document.readyState === 'complete'");
    }

    /// A window of this width, in light or dark surroundings.
    pub(crate) fn surround(&mut self, width: u32, scheme: &str) {
        let media = json!({"features": [{"name": "prefers-color-scheme", "value": scheme}]});
        self.call("Emulation.setEmulatedMedia", media);
        let size = json!({"width": width, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": false});
        self.call("Emulation.setDeviceMetricsOverride", size);
    }

    /// Writes pictures of the whole page, one a window.
    pub(crate) fn photograph(&mut self, folder: &Path, name: &str) {
        let height = self.evaluate("document.documentElement.scrollHeight").as_u64().unwrap();
        for (part, top) in (0..height).step_by(HEIGHT as usize).enumerate() {
            self.evaluate(&format!("scrollTo({{top: {top}, behavior: 'instant'}})"));
            self.wait_for(ALL_NEAR_ARE_DRAWN);
            self.picture(folder, &format!("{name}-{}", part + 1));
        }
    }

    /// Writes a picture of the window.
    pub(crate) fn picture(&mut self, folder: &Path, name: &str) {
        let picture = self.call("Page.captureScreenshot", json!({"format": "png", "optimizeForSpeed": true}));
        let bytes = base64::prelude::BASE64_STANDARD.decode(picture["data"].as_str().unwrap()).unwrap();
        std::fs::write(folder.join(format!("{name}.png")), bytes).unwrap();
    }

    pub(crate) fn mouse(&mut self, kind: &str, x: f64, y: f64) {
        let buttons = u8::from(kind != "mouseReleased");
        let event =
            json!({"type": kind, "x": x, "y": y, "button": "left", "buttons": buttons, "clickCount": 1});
        self.call("Input.dispatchMouseEvent", event);
    }

    /// Types a text where the focus is.
    pub(crate) fn write(&mut self, text: &str) {
        for letter in text.chars() {
            self.call("Input.dispatchKeyEvent", json!({"type": "char", "text": letter}));
        }
    }

    /// Presses a key; `modifiers` is 2 for Ctrl.
    pub(crate) fn press(&mut self, key: &str, modifiers: u8) {
        let code = match key {
            "Enter" => 13,
            "Escape" => 27,
            letter => letter.to_uppercase().bytes().next().map_or(0, u32::from),
        };
        for kind in ["rawKeyDown", "keyUp"] {
            let event =
                json!({"type": kind, "key": key, "windowsVirtualKeyCode": code, "modifiers": modifiers});
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// Everything that the page complained of or asked the network for.
    pub(crate) fn complaints(&self, file: &Path) -> Vec<String> {
        let own = format!("file://{}", file.display());
        let complaint = |event: &Value| {
            let parameters = &event["params"];
            let address = parameters["request"]["url"].as_str().unwrap_or_default();
            let is_inside = [&own, "data:", "blob:"].iter().any(|start| address.starts_with(*start));
            match event["method"].as_str().unwrap_or_default() {
                "Runtime.exceptionThrown" => true,
                "Runtime.consoleAPICalled" => parameters["type"] == "error",
                "Log.entryAdded" => parameters["entry"]["level"] == "error",
                "Network.requestWillBeSent" => !is_inside,
                _ => false,
            }
        };
        self.events.iter().filter(|event| complaint(event)).map(ToString::to_string).collect()
    }
}

/// The folder for pictures that a person looks at: `target/report-screenshots`.
pub(crate) fn screenshots() -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target"), PathBuf::from);
    let folder = target.join("report-screenshots");
    std::fs::create_dir_all(&folder).unwrap();
    folder.canonicalize().unwrap()
}
