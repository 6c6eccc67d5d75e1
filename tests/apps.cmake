find_package(nlohmann_json 3.11 REQUIRED)

luxfit_test(apps csv_table_test LINK luxfit_apps)
luxfit_test(apps name_pattern_test LINK luxfit_apps)
luxfit_test(apps session_errors_test LINK luxfit_apps)
luxfit_test(apps session_test LINK luxfit_apps)
luxfit_test(apps suggest_test LINK luxfit_apps)
luxfit_test(apps tag_map_test LINK luxfit_apps)
# Runs the program itself, which no test links.
luxfit_test(apps cli_bad_input_test LINK opencv_core opencv_imgcodecs nlohmann_json::nlohmann_json)
add_dependencies(apps_cli_bad_input_test luxfit)
luxfit_test(apps run_test WHOLE LINK truth_comparison nlohmann_json::nlohmann_json)
add_dependencies(apps_run_test luxfit)
