// Adds the commands of the forward model, and the charts that judge the forward model or the fit.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/cli.h"
#include "apps/commands/commands.h"
#include "apps/commands/form_factors_command.h"
#include "forward/factors/form_factors.h"

namespace luxfit {
namespace {

// `Options` is SimulateCommandOptions or ChartCommandOptions.
template <typename Options>
void AddSessionAndOut(CLI::App& command, Options& options, Invocation& invocation) {
  command.add_option("SESSION", options.session, "the session file (TOML)")->required();
  command.add_option("-o,--out", options.out, "folder for the results; nothing is written outside it")
      ->required();
  command
      .add_option("--error", options.error_percent,
                  "error that patches, rays and bounces may cause, percent of illuminance")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  AddJson(command, options.json);
  AddThreads(command, invocation);
}

void AddSimulate(CLI::App& app, Invocation& invocation) {
  CLI::App* const command = app.add_subcommand(
      "simulate", "illuminance at the readings' places, everything given and nothing fitted");
  const auto options = std::make_shared<SimulateCommandOptions>();
  AddSessionAndOut(*command, *options, invocation);
  command->final_callback([&invocation, options] {
    options->command_line = invocation.command_line;
    invocation.run = [options] { return SimulateCommand(*options); };
  });
  AddExample(*command, "luxfit simulate fixtures/forward_reference/spots/session.toml -o out",
             "session spots: simulated\n"
             "\n"
             "reading      state               lx      direct    indirect  measured lx  error %\n"
             "P0_0         A                 7.47        3.54        3.94            -        -\n"
             "...");
}

// Adds the options that chart the whole fit instead of the forward model.
void AddFitCharts(CLI::App& chart, ChartCommandOptions& options) {
  StabilityOptions& stability = options.stability_options;
  CLI::Option* const degrade = chart.add_flag(
      "--stability", options.stability,
      "degrade the session (noise, exposure, views, ...), fit it again, and chart success and error");
  CLI::Option* const fit =
      chart.add_flag("--fit", options.whole_fit,
                     "error of the whole fit against its time, over patches, views, states, ...");
  fit->excludes(degrade);
  chart.add_option("--trials", stability.trials, "trials of each level, for --stability")
      ->capture_default_str()
      ->check(CLI::PositiveNumber)
      ->needs(degrade);
  chart.add_option("--seed", stability.seed, "seed of the random numbers, for --stability")
      ->capture_default_str()
      ->needs(degrade);
  chart.add_option("--only", stability.only, "degradations to apply, for --stability (default: all)")
      ->delimiter(',')
      ->needs(degrade);
  const CLI::Option* const elements =
      chart.add_option("--elements", stability.elements, "number of observed elements that each fit uses")
          ->capture_default_str()
          ->check(CLI::PositiveNumber);
  const CLI::Option* const truth =
      chart.add_option("--truth", stability.truth_path,
                       "true luminaires as JSON (default: what the undegraded session gives)");
  chart.parse_complete_callback([degrade, fit, elements, truth] {
    if (degrade->count() + fit->count() > 0) return;
    for (const CLI::Option* const option : {elements, truth}) {
      if (option->count() > 0) throw CLI::RequiresError(option->get_name(), "--stability or --fit");
    }
  });
}

// Adds the options that draw an earlier chart in the same pictures.
void AddBefore(CLI::App& chart, EarlierChart& before) {
  CLI::Option* const path = chart.add_option(
      "--before", before.path,
      "earlier chart of the same kind and session (folder or table), drawn lighter and dashed");
  const auto add_name = [&](const std::string& flag, std::string& name, const std::string& help) {
    chart.add_option(flag, name, help)
        ->capture_default_str()
        ->needs(path)
        ->check(CLI::Validator(
            [](const std::string& typed) {
              constexpr size_t kMost = 24;  // the legend's width
              const bool fits = !typed.empty() && typed.size() <= kMost;
              return fits ? "" : "expected 1 to 24 bytes, got " + std::to_string(typed.size());
            },
            ""));
  };
  add_name("--before-name", before.names.before, "name of the earlier chart in the legend");
  add_name("--after-name", before.names.after, "name of the present chart in the legend");
}

void AddChart(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("chart", "chart speed against accuracy, of the forward model or of the whole fit");
  const auto options = std::make_shared<ChartCommandOptions>();
  AddSessionAndOut(*command, *options, invocation);
  command
      ->add_option("--budget", options->budget_s, "seconds in all; points that would take longer are skipped")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  AddEarlierResult(*command, "--result", options->earlier_result,
                   "earlier fit (folder or result.json): its luminaires and reflectances count as given");
  AddFitCharts(*command, *options);
  AddBefore(*command, options->before);
  command->final_callback([&invocation, options] {
    options->command_line = invocation.command_line;
    options->threads = invocation.threads;
    invocation.run = [options] { return ChartCommand(*options); };
  });
  AddExample(*command, "luxfit chart fixtures/forward_reference/spots/session.toml -o out --budget 4",
             "session spots: 21 points, 153 skipped; reference ± 0.69 %\n"
             "\n"
             "on the front:\n"
             "method               rays patch m element m bounces solver                 time s   error %\n"
             "malley_stratified      32     0.8       0.2 ...\n"
             "...\n"
             "$ luxfit chart fixtures/forward_reference/spots/session.toml -o again --budget 4 --before out "
             "--before-name yesterday\n"
             "...\n"
             "done      again/chart.svg");
}

void AddFormFactors(CLI::App& app, Invocation& invocation) {
  CLI::App* const sub =
      app.add_subcommand("formfactors", "form factors between the patches of a mesh, by any method");
  const auto options = std::make_shared<FormFactorsCommandOptions>();
  sub->add_option("MESH", options->mesh, "OBJ, PLY or glTF, or a session file (TOML)")->required();
  sub->add_option("-o,--out", options->file, "file to write, .csv or .json")->required();
  std::string methods;
  for (const FormFactorOps& ops : FormFactorMethods())
    methods += (methods.empty() ? "" : " | ") + std::string(ops.name);
  sub->add_option("--method", options->method, methods)->capture_default_str();
  sub->add_option("--rays", options->rays, "rays over the hemisphere of a patch")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  sub->add_option("--patch-size", options->patch_size_m, "longest side of a patch, m")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  sub->add_option("--unit", options->unit, "unit of the mesh: m | cm | mm | in | ft")->capture_default_str();
  AddJson(*sub, options->json);
  AddThreads(*sub, invocation);
  sub->final_callback([&invocation, options] {
    options->command_line = invocation.command_line;
    invocation.run = [options] { return FormFactorsCommand(*options); };
  });
  AddExample(*sub, "luxfit formfactors office/room.obj -o factors.csv",
             "540 patches, hybrid, 0.307 M rays, 0.129 s\n"
             "closure error 0.0067 (1 - row sum, rms, before it is enforced), reciprocity error 0.03");
}

}  // namespace

void AddForwardCommands(CLI::App& app, Invocation& invocation) {
  AddSimulate(app, invocation);
  AddFormFactors(app, invocation);
  AddChart(app, invocation);
}

}  // namespace luxfit
