/* FMI 2.0, co-simulation: a table of outputs over inputs. */
#include "table.h"

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT int fmi2SetDebugLogging(void *c, int on, size_t n, const char *const names[])
{
    UNUSED(c), UNUSED(on), UNUSED(n), UNUSED(names);
    return OK;
}
EXPORT void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources,
                             const void *functions, int visible, int logging)
{
    UNUSED(name), UNUSED(resources), UNUSED(functions), UNUSED(visible), UNUSED(logging);
    return type == 1 ? create(guid) : NULL; /* 1: co-simulation */
}
EXPORT void fmi2FreeInstance(void *c) { free(c); }
EXPORT int fmi2SetupExperiment(void *c, int defined, double tolerance, double start, int stop, double end)
{
    UNUSED(defined), UNUSED(tolerance), UNUSED(stop), UNUSED(end);
    step(c, start);
    return OK;
}
EXPORT int fmi2EnterInitializationMode(void *c) { return UNUSED(c), OK; }
EXPORT int fmi2ExitInitializationMode(void *c) { return UNUSED(c), OK; }
EXPORT int fmi2Terminate(void *c) { return UNUSED(c), OK; }
EXPORT int fmi2Reset(void *c) { return reset(c), OK; }
EXPORT int fmi2GetReal(void *c, const Reference r[], size_t n, double v[]) { return get(c, r, n, v) ? ERROR : OK; }
EXPORT int fmi2SetReal(void *c, const Reference r[], size_t n, const double v[])
{
    return set(c, r, n, v) ? ERROR : OK;
}
EXPORT int fmi2GetFMUstate(void *c, void **state)
{
    return save(c, state);
}
EXPORT int fmi2SetFMUstate(void *c, void *state) { return memcpy(c, state, sizeof(Table)), OK; }
EXPORT int fmi2FreeFMUstate(void *c, void **state)
{
    return UNUSED(c), discard(state);
}
EXPORT int fmi2DoStep(void *c, double time, double size, int final)
{
    UNUSED(final);
    step(c, time + size);
    return OK;
}

/* Not needed: no other types, clocks, states or derivatives. */
WITHOUT(fmi2CancelStep)
WITHOUT(fmi2DeSerializeFMUstate)
WITHOUT(fmi2GetBoolean)
WITHOUT(fmi2GetBooleanStatus)
WITHOUT(fmi2GetDirectionalDerivative)
WITHOUT(fmi2GetInteger)
WITHOUT(fmi2GetIntegerStatus)
WITHOUT(fmi2GetRealOutputDerivatives)
WITHOUT(fmi2GetRealStatus)
WITHOUT(fmi2GetStatus)
WITHOUT(fmi2GetString)
WITHOUT(fmi2GetStringStatus)
WITHOUT(fmi2SerializeFMUstate)
WITHOUT(fmi2SerializedFMUstateSize)
WITHOUT(fmi2SetBoolean)
WITHOUT(fmi2SetInteger)
WITHOUT(fmi2SetRealInputDerivatives)
WITHOUT(fmi2SetString)
