//! Writes the JSON Schema of the design file to `docs/schemas/` of the repository.

fn main() -> std::io::Result<()> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas");
    std::fs::write(format!("{folder}/cdpr-design-1.schema.json"), cdpr_assess::design_schema())
}
