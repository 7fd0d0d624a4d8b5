# uPlot by npm, at the version and hash of package-lock.json: sets page_plots_folder, and page_plots
# to its uplot.js and uplot.css there. Without npm or network page_plots is empty, and the page draws
# plots of its own.
set(page_plots_folder ${CMAKE_CURRENT_BINARY_DIR}/page_plots)
set(page_plots ${page_plots_folder}/uplot.js ${page_plots_folder}/uplot.css)
set(lock ${CMAKE_CURRENT_LIST_DIR}/package-lock.json)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${lock})

if(NOT EXISTS ${page_plots_folder}/uplot.css OR ${lock} IS_NEWER_THAN ${page_plots_folder}/uplot.css)
  file(REMOVE_RECURSE ${page_plots_folder})
  find_program(NPM npm)
  mark_as_advanced(NPM)
  set(failed "there is no npm")
  if(NPM)
    file(COPY ${CMAKE_CURRENT_LIST_DIR}/package.json ${lock} DESTINATION ${page_plots_folder})
    execute_process(
      COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-timeout=15000
      WORKING_DIRECTORY ${page_plots_folder} TIMEOUT 60
      RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  endif()
  if(failed)
    message(STATUS "The operator page draws its own plots: no uPlot (npm: ${failed})")
    set(page_plots "")
  else()
    set(uplot ${page_plots_folder}/node_modules/uplot/dist)
    configure_file(${uplot}/uPlot.esm.js ${page_plots_folder}/uplot.js COPYONLY)
    configure_file(${uplot}/uPlot.min.css ${page_plots_folder}/uplot.css COPYONLY)
    file(TOUCH ${page_plots_folder}/uplot.css)
  endif()
endif()
