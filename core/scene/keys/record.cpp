// An earthquake record that prescribes a motion: [[stage.move]], factor.
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {
namespace {

// the words of `record_units` (core/exchange/record_file.hpp), as a test requires
const std::vector<std::string_view> unit_words{"g", "m/s2", "cm/s2", "gal", "m/s", "cm/s", "mm/s", "m", "cm", "mm"};

const Words<MotionQuantity> quantity_words{{"acceleration", MotionQuantity::acceleration},
                                           {"velocity", MotionQuantity::velocity},
                                           {"displacement", MotionQuantity::displacement}};

template <class Owner, class T>
KeyMember unit_member(T Owner::*at) {
  KeyMember made = in(at);
  made.type = choice;
  made.choices = unit_words;
  return made;
}

template <class Owner>
KeyMember quantity_member(std::optional<MotionQuantity> Owner::*at) {
  KeyMember made = key_member(
      at, KeyType::choice,
      [](const Node& value, std::optional<MotionQuantity>& target) { target = meaning_of(quantity_words, value.text); },
      [](const std::optional<MotionQuantity>& value) {
        return value ? toml_text(word_for(quantity_words, *value)) : "";
      });
  made.choices = choices_of(quantity_words);
  return made;
}

}  // namespace

// clang-format off
KeyTable record_keys() {
  return {"record", {
    {.key = "record", .members = {in(&RecordSpec::file)}, .example = "\"record.at2\"", .required = true,
     .meaning = "the file, in the scene's folder: AT2 of the PEER database, a table of times and values (blanks, commas, semicolons or "
         "tabs), or one column of values at equal intervals"},
    {.key = "quantity", .members = {quantity_member(&RecordSpec::quantity)}, .example = "\"acceleration\"",
     .meaning = "what the values are; without it what the file or the unit says. They are linear in time in between"},
    {.key = "unit", .members = {unit_member(&RecordSpec::unit)}, .example = "\"g\"",
     .meaning = "unit of the values; needed if the file does not state it, as AT2 does. g is 9.80665 m/s², whatever the scene's gravity"},
    {.key = "interval_s", .members = {in(&RecordSpec::interval)}, .unit = "s", .range = {1e-6, 10}, .plausible = {0.0005, 0.1},
     .example = "0.01", .meaning = "time from one value to the next, of a file without times", .mistake = "was it given in ms, or in Hz?"},
    {.key = "column", .members = {in(&RecordSpec::column)}, .range = {1, 1000}, .example = "2",
     .meaning = "column of the values, from 1, of a file with more than one beside the times"},
    {.key = "scale", .members = {in(&RecordSpec::scale)}, .unit = "1", .range = {0, 1e6, true}, .plausible = {0.05, 20},
     .example = "1.5", .meaning = "factor of the values", .mistake = "is the unit right?"},
    {.key = "polarity", .members = {one_of(&RecordSpec::reversed, {{"as_recorded", false}, {"reversed", true}})},
     .example = "\"reversed\"", .meaning = "reversed: the values with the other sign; a slope is to be computed with both"},
    {.key = "baseline", .members = {one_of(&RecordTreatment::baseline, {{"none", Baseline::none}, {"mean", Baseline::mean},
                                                                        {"end", Baseline::end}})}, .example = "\"end\"",
     .meaning = "correction of the values. none: as recorded, with the permanent displacement of a near fault. mean: a constant, so "
         "that the velocity is zero at the end (of recorded velocities the displacement). end: of accelerations the least straight "
         "line that makes velocity and displacement zero at the end",
     .breaks = "a record that starts with a jump, as a sine does, is bent by end: check prints how much was taken off"},
    {.key = "from_s", .members = {in(&RecordTreatment::from)}, .unit = "s", .range = {0, 1e6}, .example = "5",
     .meaning = "values before this time of the record are left out; its first value is at 0"},
    {.key = "to_s", .members = {in(&RecordTreatment::to)}, .unit = "s", .range = {0, 1e6, true}, .example = "25", .no_default = true,
     .meaning = "values after this time of the record are left out"},
    {.key = "pad_s", .members = {in(&RecordTreatment::pad)}, .unit = "s", .range = {0, 1e6}, .example = "1",
     .meaning = "rest before the record begins"},
    {.key = "direction", .members = {in(&RecordSpec::direction)}, .unit = "1", .range = sane, .example = "[1, 0, 0]",
     .no_default = true, .meaning = "direction of positive values, of any length; or state azimuth_deg"},
    {.key = "azimuth_deg", .members = {degrees(&RecordSpec::azimuth)}, .unit = "deg", .range = direction_range,
     .plausible = plausible_direction, .example = "270", .no_default = true,
     .meaning = "in 3-D a horizontal direction of positive values, clockwise from north (y)", .repair = direction_repair,
     .mistake = angle_mistake},
    {.key = "samples", .members = {group(&RecordSpec::samples, "samples")},
     .meaning = "what the file contains; then it is not read. The scene.toml of a run has it"},
  }};
}

KeyTable samples_keys() {
  return {"samples", {
    {.key = "values", .members = {in(&SamplesSpec::values, numbers)}, .range = sane, .example = "[0, 0.1, 0]", .required = true,
     .meaning = "values at equal intervals, in their unit"},
    {.key = "interval_s", .members = {in(&SamplesSpec::interval)}, .unit = "s", .range = {1e-6, 10}, .example = "0.01", .required = true,
     .meaning = "time from one value to the next"},
    {.key = "unit", .members = {unit_member(&SamplesSpec::unit)}, .example = "\"g\"", .meaning = "unit that the file states"},
    {.key = "quantity", .members = {quantity_member(&SamplesSpec::quantity)}, .example = "\"acceleration\"",
     .meaning = "what the file says that the values are"},
    {.key = "component", .members = {in(&SamplesSpec::component)}, .example = "\"270\"",
     .meaning = "last word of AT2's second line: an azimuth or a word"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
