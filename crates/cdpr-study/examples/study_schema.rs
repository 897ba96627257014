//! Writes the JSON Schema of the study file to `docs/schemas/` of the repository.

fn main() -> std::io::Result<()> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas/cdpr-study-1.schema.json");
    std::fs::write(path, cdpr_study::json_schema())
}
