//! Writes the JSON Schemas of the study, the law and the errors file to `docs/schemas/` of the repository.

fn main() -> std::io::Result<()> {
    for (file, schema) in [
        ("cdpr-study-1", cdpr_study::json_schema()),
        ("cdpr-law-1", cdpr_study::law_schema()),
        ("cdpr-errors-1", cdpr_study::errors_schema()),
    ] {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas");
        std::fs::write(format!("{folder}/{file}.schema.json"), schema)?;
    }
    Ok(())
}
