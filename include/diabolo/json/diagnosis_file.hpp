// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "diabolo/diagnose/diagnosis_result.hpp"
#include "diabolo/json/fields.hpp"
#include "diabolo/json/records.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

/// The text of a file of the schema diabolo.diagnosis/1 (docs/diagnosis.md). Throws RecordingError where a
/// text in it is not UTF-8.
inline std::string write_diagnosis(const DiagnosisResult& result) {
  return json_text(record_to_json(result), "diagnosis");
}

/// Reads such a text; what it lacks is as in an empty result. Throws RecordingError with file, field, what
/// was found and what was expected.
inline DiagnosisResult read_diagnosis(std::string_view text, const std::string& file_name) {
  const nlohmann::json json = parse_json(text, file_name);
  JsonFields(json, file_name).expect_text("schema", kDiagnosisSchema);
  DiagnosisResult result;
  read_record(json, result, file_name + ": ");
  return result;
}

/// Reads a file; see read_diagnosis().
inline DiagnosisResult load_diagnosis(const std::filesystem::path& path) {
  return read_diagnosis(read_file(path), path.string());
}

/// The JSON schema of such files, as docs/diagnosis.schema.json has it.
inline std::string diagnosis_schema() {
  nlohmann::ordered_json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                                {"title", kDiagnosisSchema}};
  schema.update(record_schema<DiagnosisResult>());
  return schema.dump(1) + "\n";
}

}  // namespace diabolo
