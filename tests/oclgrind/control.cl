/* What scripts/oclgrind.sh must find before its silence means anything. */
__kernel void writesPastItsBuffer(__global uint* buffer) { buffer[get_global_id(0) + 1] = 1; }
__kernel void raceForOneWord(__global uint* buffer) { buffer[0] += (uint)get_global_id(0); }
