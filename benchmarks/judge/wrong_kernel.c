/* Two libraries that the judge must refuse: one of another version, one without voussoir_contact. */
#include "voussoir_kernel.h"

#ifdef OF_ANOTHER_VERSION
int32_t voussoir_kernel_version(void) { return VOUSSOIR_KERNEL_VERSION + 1; }
#else
int32_t voussoir_kernel_version(void) { return VOUSSOIR_KERNEL_VERSION; }
const char* voussoir_kernel_name(void) { return "without contacts"; }
#endif
