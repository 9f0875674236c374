#!/bin/sh
# Devices that crash, hang, vanish or run out of memory: ./device_faults.sh STOKES OPENCL_FAULTS.SO. The right exit code, a message that says what
# to do, and the bits of an undisturbed render wherever there is an image.
. "$(dirname -- "$0")/../cli/common.sh" "$1"
faults=$2
export XDG_CACHE_HOME="$WORK/cache"
scene=$FIXTURES/../cli/small.json

# Kernels of this integrator are built soonest. What should end by itself and does not fails with 137.
stokes_render() {
  timeout -s KILL 300 "$STOKES" render "$scene" --integrator normals --spp 400 "$@"
}

# broken RULES ARGUMENTS...: a render with faults.
broken() {
  rules=$1
  shift
  LD_PRELOAD=$faults OPENCL_FAULTS=$rules stokes_render "$@"
}
# The same, with one fault for all its processes.
once() {
  rm -f once
  OPENCL_FAULTS_ONCE=$WORK/once broken "$@"
}
same_as_whole() {
  "$STOKES" compare whole.exr "$1" --exact >compare.txt || fail "$1 has other bits than an undisturbed render"
}

"$STOKES" devices >devices.txt 2>&1 || { echo 'there is no OpenCL device to break'; exit 1; }
expect 0 stokes_render -o whole.exr

# A crash costs an attempt, not the render; with a checkpoint it continues from there. A second crash without progress is the end.
expect 0 once clEnqueueNDRangeKernel@3=segv -o a.exr
says err.txt 'warning: a crash \(signal 11\) while rendering; trying again with empty caches$'
same_as_whole a.exr
expect 0 once clEnqueueNDRangeKernel@6=abort -o b.exr --checkpoint 1ms
says err.txt 'trying again with empty caches from b.exr.checkpoint'
says err.txt 'resuming b.exr.checkpoint after [0-9]+ samples'
same_as_whole b.exr
[ -e b.exr.checkpoint ] && fail 'the checkpoint of a finished render is still there'
expect 3 broken clEnqueueNDRangeKernel@3+=segv -o c.exr
says err.txt '^error: a crash \(signal 11\) while rendering, again: the OpenCL driver may be broken'
[ -e c.exr ] && fail 'a render that crashed left an output'
# A driver's exit is no success, whatever its code.
expect 0 once clEnqueueNDRangeKernel@3=exit -o f.exr
says err.txt "warning: an exit of the driver's own \(code 0\) while rendering; trying again"
same_as_whole f.exr
expect 0 once clBuildProgram@1=segv -o d.exr
says err.txt 'while building kernels'
same_as_whole d.exr
# Code that the driver loads is damaged under its hands.
expect 0 once clEnqueueNDRangeKernel@1=truncate -o e.exr
same_as_whole e.exr

# A launch without end is given up, one that ends late is not.
expect 3 broken clEnqueueNDRangeKernel@6=hang -o h.exr --checkpoint 1ms --launch-timeout 1s
says err.txt '^error: the device gave no sign of life for [0-9]+ s while rendering; h.exr.checkpoint holds'
expect 0 stokes_render -o h.exr --resume
same_as_whole h.exr
# Ctrl-C ends even a driver that hangs.
LD_PRELOAD=$faults OPENCL_FAULTS=clBuildProgram@1=hang "$STOKES" render "$scene" -q -o i.exr 2>err.txt &
pid=$!
tries=0
until grep -q 'fault:' err.txt || [ $tries -ge 600 ]; do
  sleep 0.1
  tries=$((tries + 1))
done
kill -INT $pid
tries=0
while kill -0 $pid 2>/dev/null && [ $tries -lt 600 ]; do
  sleep 0.1
  tries=$((tries + 1))
done
kill -KILL $pid 2>/dev/null
wait $pid
[ $? -eq 6 ] || fail 'Ctrl-C does not end a hanging driver with exit code 6'

# A device that is lost: the call, the code, and where the work is.
expect 3 broken clEnqueueNDRangeKernel@6=-2 -o l.exr --checkpoint 1ms
says err.txt '^error: clEnqueueNDRangeKernel failed with CL_DEVICE_NOT_AVAILABLE on .*; l.exr.checkpoint holds'
expect 0 stokes_render -o l.exr --resume
same_as_whole l.exr
expect 3 broken clFinish@4=-36 -o l.exr --restart
says err.txt 'CL_INVALID_COMMAND_QUEUE'

# Memory, of the device and of the machine.
expect 4 broken clCreateBuffer@1+=-4 -o m.exr
says err.txt '^error: out of memory: need [0-9]+ MiB, the device has [0-9]+ MiB in all: clCreateBuffer failed'
expect 4 broken clEnqueueNDRangeKernel@4=-4 -o m.exr
says err.txt '^error: out of memory: need .*clEnqueueNDRangeKernel'
expect 4 broken clEnqueueNDRangeKernel@4=kill -o m.exr
says err.txt 'killed .*when memory runs out'

# Builds: without optimisation if need be, with a warning; and never an endless loop.
expect 0 broken clBuildProgram:optimised@1+=-11 -o o.exr
says err.txt '^warning: the kernels built only without optimisation'
expect 0 "$STOKES" info o.exr
expect 3 broken clBuildProgram@1+=-11 -o p.exr
says err.txt '^error: clBuildProgram failed with CL_'
expect 0 broken clEnqueueNDRangeKernel@1=-5 -o q.exr
same_as_whole q.exr

# No devices at all: of a platform, of the machine.
expect 3 broken clGetDeviceIDs@1+=-1 -o n.exr
says err.txt '^error: no OpenCL device was found'
mkdir no_vendors
expect 3 env OCL_ICD_VENDORS="$WORK/no_vendors" "$STOKES" render "$scene" -o n.exr
says err.txt '^error: no OpenCL device was found.*--device reference'
finish
