# What the simulator and the programs need beside Eigen; tools/install_dependencies lists the Debian packages.

find_package(box2d 2.4 REQUIRED)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(CLI11 2 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(nlohmann_json 3 REQUIRED)
find_package(TBB REQUIRED)
find_package(NLopt 2.7 REQUIRED)
find_package(OpenCV 4 REQUIRED COMPONENTS core imgproc imgcodecs videoio)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
