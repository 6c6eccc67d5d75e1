# Debian packages by cpack: `luxfit` (program, Python module, documentation, the example room) and `libluxfit-dev`
# (libraries, headers, CMake configuration). What an install() rule does not name a component for is the program's.
#
#   cmake --preset package && cmake --build build/package && cpack --preset deb
set(documents ${CMAKE_INSTALL_DOCDIR})

install(FILES README.md CONVENTIONS.md DESTINATION ${documents})
install(DIRECTORY docs/ DESTINATION ${documents}/docs FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png"
        PATTERN "*.csv" PATTERN "schema" EXCLUDE)
install(DIRECTORY docs/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/luxfit)
install(FILES apps/python/example.py apps/python/from_photos.py DESTINATION ${documents}/examples)

# Debian wants a copyright file and a packed changelog of its own form in every package; CHANGELOG.md goes beside them.
set(maintainer "luxfit contributors <contributors@luxfit.example>")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/debian/copyright @ONLY CONTENT
[=[Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: luxfit

Files: *
Copyright: 2026 luxfit contributors
License: Apache-2.0

License: Apache-2.0
 Licensed under the Apache License, Version 2.0 (the "License"); you may not use this file except in compliance with
 the License. Unless required by applicable law or agreed to in writing, software distributed under the License is
 distributed on an "AS IS" BASIS, WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied. See the
 License for the specific language governing permissions and limitations under the License.
 .
 On Debian systems, the complete text of the Apache version 2.0 license can be found in
 "/usr/share/common-licenses/Apache-2.0".
]=])
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/debian/changelog @ONLY CONTENT
[=[luxfit (@PROJECT_VERSION@) unstable; urgency=medium

  * What changed stands in CHANGELOG.md.gz.

 -- @maintainer@  @date@
]=])
foreach(pair "debian/changelog=${PROJECT_BINARY_DIR}/debian/changelog" "debian/CHANGELOG.md=${PROJECT_SOURCE_DIR}/CHANGELOG.md")
  string(REGEX MATCH "^([^=]*)=(.*)$" pair ${pair})
  execute_process(COMMAND gzip -9nc ${CMAKE_MATCH_2} OUTPUT_FILE ${PROJECT_BINARY_DIR}/${CMAKE_MATCH_1}.gz
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS CHANGELOG.md)
install(FILES ${PROJECT_BINARY_DIR}/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
              ${PROJECT_BINARY_DIR}/debian/CHANGELOG.md.gz DESTINATION ${documents})
install(FILES ${PROJECT_BINARY_DIR}/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libluxfit-dev COMPONENT dev)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME luxfit)
set(CPACK_PACKAGE_CONTACT ${maintainer})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "inverse-lighting calibration of rooms")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/before_packing.cmake)
# 022 whatever the umask of who builds.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME luxfit)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
# COLMAP registers views that see no tag; without it those are left out, with a warning or exit status 3.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS colmap)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"From photos of a room, its mesh and one luxmeter reading, luxfit finds every
luminaire's position, flux and distribution and every surface's reflectance,
each with its uncertainty, checked against further readings.
.
Contains the program, a Python module with numpy arrays, the documentation
and example rooms, /usr/share/luxfit/office and openplan.")
if(LUXFIT_PYTHON)
  math(EXPR next_minor "${LUXFIT_PYTHON_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
      "python3 (>= 3.${LUXFIT_PYTHON_VERSION_MINOR}~), python3 (<< 3.${next_minor}), python3-numpy")
endif()

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libluxfit-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# What luxfitConfig.cmake finds again.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "coinor-libclp-dev, libapriltag-dev, libceres-dev, libeigen3-dev, libembree-dev, libexiv2-dev, libfmt-dev, libheif-dev, liblcms2-dev, libmrcal-dev, \
libopenblas-dev, libopencv-dev, libraw-dev, libsqlite3-dev, libtbb-dev, libyaml-cpp-dev, pkg-config")
set(CPACK_COMPONENT_DEV_DESCRIPTION
"Static libraries and headers for find_package(luxfit) of CMake: luxfit::calib
(cameras, tags, registration), luxfit::forward (radiosity, photometric files)
and luxfit::inverse (luminaires and reflectances from observed light).")
include(CPack)
