// The one place that includes the OpenCL bindings, with the settings every file must share. Internal to runtime/device: no
// header that others include may include it.
#pragma once
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>
