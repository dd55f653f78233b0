#include "info_options.hpp"

#include <CLI/CLI.hpp>

#include "backend_list.hpp"

namespace hg::info {

ParsedOptions parse_options(int argc, const char *const *argv) {
  CLI::App app{
      "Backends of the library that this program finds: lists them, says what they can do, checks one.\n"
      "Plugins are found beside the library, in the folders of CEED_PLUGIN_PATH, and by --plugin."};
  app.footer(
      "Exit status: 0 all is well; 1 a case of the suite failed; 2 a bad option or plugin; 3 a backend that was asked\n"
      "for is not available; 4 the conformance suite is not installed or does not run.");
  InfoOptions options;
  std::string check, json;
  std::vector<std::string> resources;
  bool support = false, memory = false;
  auto *check_option = app.add_option("--check", check,
                                      "run the conformance suite on this backend, in or out of the tree, and print\n"
                                      "what failed and why");
  app.add_flag("--support", support, "run the suite on every available backend and print the table of what they can do")
      ->excludes(check_option);
  app.add_flag("--memory", memory, "print the bytes that two operators hold on every available backend")
      ->excludes(check_option)
      ->excludes("--support");
  app.add_option("--ceed", resources, "with --support and --memory: this backend only; repeat for several");
  app.add_option("--plugin", options.plugins, "load this plugin library too; repeat for several")->check(CLI::ExistingFile);
  app.add_option("--cases", options.cases,
                 "only cases of the suite that match, as a filter of GoogleTest: '*Points*:-*Random*'");
  app.add_flag("--detail", options.is_detailed, "with --support: a line for each case");
  app.add_flag("--verbose", options.is_shown, "show what the suite prints as it runs");
  app.add_option("--json", json, "write what was found to this file; `-`: to standard output, instead of the text");
  app.set_version_flag("--version", [] { return library_text(); });
  try {
    app.parse(argc, argv);
    if (!support && !memory && !resources.empty()) throw CLI::RequiresError("--ceed", "--support or --memory");
    if (!support && options.is_detailed) throw CLI::RequiresError("--detail", "--support");
    if (!support && check.empty() && !options.cases.empty()) throw CLI::RequiresError("--cases", "--check or --support");
    if (check_option->count() > 0 && check.empty()) throw CLI::ValidationError("--check", "expected a resource");
  } catch (const CLI::ParseError &error) {
    return {{}, app.exit(error) == 0 ? exit_fine : exit_usage};
  }
  options.task = support ? Task::support : memory ? Task::memory : check.empty() ? Task::list : Task::check;
  options.resources = options.task == Task::check ? std::vector{check} : resources;
  if (!json.empty()) options.json = json;
  return {options, exit_fine};
}

}  // namespace hg::info
