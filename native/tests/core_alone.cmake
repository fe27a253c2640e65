# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the component core of BUILD into FOLDER, and builds and runs the program FIRST with it. Fails if anything of seamwire_uv is
# installed, or if the package claims to have it.
cmake_minimum_required(VERSION 3.25)

function(run expected)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(expected STREQUAL "" AND NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${output}")
  elseif(NOT expected STREQUAL "" AND NOT output MATCHES "${expected}")
    message(FATAL_ERROR "${ARGN}: expected ${expected}, got ${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run("" ${CMAKE_COMMAND} --install ${BUILD} --component core --prefix ${FOLDER}/installed)
file(GLOB_RECURSE installed ${FOLDER}/installed/*)
list(FILTER installed INCLUDE REGEX "seamwire_uv")
if(installed)
  message(FATAL_ERROR "The component core has ${installed}")
endif()
set(options -G ${GENERATOR} -Dseamwire_ROOT=${FOLDER}/installed -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run("" ${CMAKE_COMMAND} -S ${FIRST} -B ${FOLDER}/first ${options})
run("" ${CMAKE_COMMAND} --build ${FOLDER}/first)
run("in the metric" ${FOLDER}/first/first ${FIRST}/squares.obj 0 5)

file(WRITE ${FOLDER}/both/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\nproject(both LANGUAGES CXX)\nfind_package(seamwire REQUIRED COMPONENTS core uv)\n")
run("The component uv of seamwire is[ \n]+not[ \n]+installed" ${CMAKE_COMMAND} -S ${FOLDER}/both -B ${FOLDER}/both/build ${options})
