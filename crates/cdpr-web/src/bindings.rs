//! What JavaScript sees of the module.

use crate::Live;
use wasm_bindgen::prelude::*;

/// A robot that answers, see [`crate::Live`].
#[wasm_bindgen(js_name = Live)]
pub struct PageLive(Live);

#[wasm_bindgen(js_class = Live)]
impl PageLive {
    /// A robot from the text of its file.
    ///
    /// # Errors
    /// Why the text is no robot.
    #[wasm_bindgen(constructor)]
    pub fn new(robot: &str) -> Result<Self, JsError> {
        Ok(Self(Live::new(robot)?))
    }

    /// The answer to a question, both as JSON.
    pub fn ask(&mut self, question: &str) -> String {
        self.0.ask(question)
    }
}
