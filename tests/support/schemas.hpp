// SPDX-License-Identifier: MIT
// The schemas of docs/schemas, by a validator that is not ours.
#pragma once

#include <rapidjson/document.h>
#include <rapidjson/error/en.h>
#include <rapidjson/schema.h>
#include <rapidjson/stringbuffer.h>

#include <fstream>
#include <iterator>
#include <string>

namespace lacuna::testing {

inline std::string schema_text(const std::string& name) {
  std::ifstream file(std::string(LACUNA_SOURCE_DIR) + "/docs/schemas/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline rapidjson::Document parsed_schema(const std::string& name) {
  rapidjson::Document document;
  document.Parse(schema_text(name).c_str());
  return document;
}

/// The schema to which others refer.
class ModelSchema : public rapidjson::IRemoteSchemaDocumentProvider {
 public:
  const rapidjson::SchemaDocument* GetRemoteDocument(const char*,
                                                     rapidjson::SizeType) override {
    return &schema_;
  }

 private:
  rapidjson::SchemaDocument schema_{parsed_schema("model.schema.json")};
};

/// Where and by which rule a text is not what the schema `name` says ("fit"); empty where it
/// is.
inline std::string violation(const std::string& name, const std::string& text) {
  ModelSchema model;
  const rapidjson::Document source = parsed_schema(name + ".schema.json");
  if (source.HasParseError() || !source.IsObject()) return "no schema " + name;
  const rapidjson::SchemaDocument schema(source, &model);
  rapidjson::SchemaValidator validator(schema);
  rapidjson::Document document;
  document.Parse(text.c_str());
  if (document.HasParseError())
    return std::string(rapidjson::GetParseError_En(document.GetParseError())) + " in " +
           text.substr(0, 200);
  if (document.Accept(validator)) return "";
  rapidjson::StringBuffer place;
  validator.GetInvalidDocumentPointer().StringifyUriFragment(place);
  return std::string(place.GetString()) + " breaks " + validator.GetInvalidSchemaKeyword();
}

}  // namespace lacuna::testing
