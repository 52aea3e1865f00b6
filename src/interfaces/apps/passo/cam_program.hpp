// Writes the program of an operation of `passo cam` in the words of the controller of --for, with the operator's texts.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "cam_commands.hpp"
#include "length_arguments.hpp"
#include "named_files.hpp"

#include "passo/cam/drill_program.hpp"
#include "passo/cam/mill_program.hpp"
#include "passo/carve/relief_program.hpp"
#include "passo/post_processor/post_processor.hpp"
#include "passo/report/output_file.hpp"

namespace passo {

// Checks --for and the operator's texts before any work. Shows the errors. `units`: those of the program.
bool program_words_are_good(const CamProgramArguments& arguments, const std::string& units);

// Returns the options for a program in `units`. `read_unit`: the unit in which the program was written.
PostProcessorOptions post_processor_options_of(const CamProgramArguments& arguments, const std::string& units,
                                               LengthUnit read_unit);

// Whether the program is to be written as it is.
bool is_plain_program(const CamProgramArguments& arguments);

// The files that an operation reads besides its drawings.
void name_texts_read(const CamProgramArguments& arguments, NamedFiles& files);
void name_library_read(const CamToolArguments& arguments, NamedFiles& files);

// M7, M8, or nothing.
std::string_view coolant_word(const CamProgramArguments& arguments);
SafeChange safe_change_of(const CamProgramArguments& arguments, LengthArguments& lengths);

// These write to `arguments.output`, or to standard output if it is empty. They return an exit code.
int write_program(const CamMillArguments& arguments, const MillPlan& plan, const MillProgramOptions& options);
int write_program(const CamDrillArguments& arguments, const DrillPlan& plan, const DrillProgramOptions& options);
// A program without tools, e.g. for a pen.
int write_program(const CamMillArguments& arguments, const std::string& text, const std::string& name, DrawnPoint park);

// Writes a relief while it is generated. `refused`: why the controller cannot run it; empty if it can.
ReliefReport write_relief_in_words(const CamReliefArguments& arguments, const ReliefProgramOptions& program,
                                   OutputFile& file, std::optional<std::string>& refused,
                                   const std::function<ReliefReport(const ReliefSink&)>& make);

}  // namespace passo
