# Third parties of the program, the benchmarks and the tests only.
if(PREHENSILE_APPS)
  find_package(CLI11 REQUIRED)
  find_package(Threads REQUIRED)
  find_package(tinyxml2 REQUIRED)
endif()

if(PREHENSILE_APPS AND PREHENSILE_MUJOCO)
  # The configuration that Debian installs asks for OpenGL, which this does not use.
  find_path(MUJOCO_INCLUDE mujoco/mujoco.h REQUIRED)
  find_library(MUJOCO_LIBRARY mujoco REQUIRED)
  add_library(prehensile_mujoco INTERFACE)
  target_include_directories(prehensile_mujoco SYSTEM INTERFACE ${MUJOCO_INCLUDE})
  target_link_libraries(prehensile_mujoco INTERFACE ${MUJOCO_LIBRARY})
endif()

if(PREHENSILE_APPS AND PREHENSILE_SUITE)
  find_package(SQLite3 3.24 REQUIRED)
endif()

if(PREHENSILE_APPS AND PREHENSILE_VIEWER AND PREHENSILE_GLTF)
  find_package(TinyGLTF REQUIRED)
endif()

if(PREHENSILE_TESTS)
  find_package(GTest REQUIRED)
endif()
