# Third parties of the libraries, each as one imported target, for this build and for projects that
# find an installed package. Headers are SYSTEM: their warnings are not ours.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)

if(PREHENSILE_NLOPT)
  find_package(NLopt REQUIRED)
endif()

if(PREHENSILE_IPOPT)
  find_package(Ipopt MODULE REQUIRED)
endif()

if(PREHENSILE_OBSTACLES)
  find_package(fcl 0.7 REQUIRED)
  add_library(prehensile_fcl INTERFACE IMPORTED)
  target_link_libraries(prehensile_fcl INTERFACE fcl)
endif()

if(PREHENSILE_OMPL)
  # OMPL 1.5 exports variables, no target.
  find_package(ompl 1.5 REQUIRED)
  add_library(prehensile_ompl INTERFACE IMPORTED)
  target_include_directories(prehensile_ompl SYSTEM INTERFACE ${OMPL_INCLUDE_DIRS})
  target_link_libraries(prehensile_ompl INTERFACE ${OMPL_LIBRARIES})
endif()

if(PREHENSILE_APPS)
  find_package(yaml-cpp 0.7 REQUIRED)
  add_library(prehensile_yaml INTERFACE IMPORTED)
  target_link_libraries(prehensile_yaml INTERFACE yaml-cpp)
  find_package(nlohmann_json 3.11 REQUIRED)
  find_package(ZLIB REQUIRED)
endif()

if(PREHENSILE_MESHES)
  find_package(tinyxml2 REQUIRED)
  find_package(assimp 5.2 REQUIRED)
  find_path(POLYCLIPPING_INCLUDE polyclipping/clipper.hpp REQUIRED)
  find_library(POLYCLIPPING_LIBRARY polyclipping REQUIRED)
  add_library(prehensile_polyclipping INTERFACE IMPORTED)
  target_include_directories(prehensile_polyclipping SYSTEM INTERFACE
    ${POLYCLIPPING_INCLUDE})
  target_link_libraries(prehensile_polyclipping INTERFACE ${POLYCLIPPING_LIBRARY})
endif()
