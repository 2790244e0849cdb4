/* FMI 3.0, co-simulation: a table of outputs over inputs. */
#include <stdbool.h>
#include "table.h"

typedef const char *String;

EXPORT const char *fmi3GetVersion(void) { return "3.0"; }
EXPORT int fmi3SetDebugLogging(void *c, bool on, size_t n, const String names[])
{
    return UNUSED(c), UNUSED(on), UNUSED(n), UNUSED(names), OK;
}
EXPORT void *fmi3InstantiateCoSimulation(String name, String token, String resources, bool visible, bool logging,
                                         bool events, bool early, const Reference required[], size_t n,
                                         void *environment, void *log, void *intermediate)
{
    UNUSED(name), UNUSED(resources), UNUSED(visible), UNUSED(logging), UNUSED(events), UNUSED(early);
    UNUSED(required), UNUSED(n), UNUSED(environment), UNUSED(log), UNUSED(intermediate);
    return create(token);
}
EXPORT void fmi3FreeInstance(void *c) { free(c); }
EXPORT int fmi3EnterInitializationMode(void *c, bool defined, double tolerance, double start, bool stop, double end)
{
    UNUSED(defined), UNUSED(tolerance), UNUSED(stop), UNUSED(end);
    step(c, start);
    return OK;
}
EXPORT int fmi3ExitInitializationMode(void *c) { return UNUSED(c), OK; }
EXPORT int fmi3EnterStepMode(void *c) { return UNUSED(c), OK; }
EXPORT int fmi3EnterConfigurationMode(void *c) { return UNUSED(c), OK; }
EXPORT int fmi3ExitConfigurationMode(void *c) { return UNUSED(c), OK; }
EXPORT int fmi3Terminate(void *c) { return UNUSED(c), OK; }
EXPORT int fmi3Reset(void *c) { return reset(c), OK; }
EXPORT int fmi3GetFloat64(void *c, const Reference r[], size_t n, double v[], size_t m)
{
    return n == m && !get(c, r, n, v) ? OK : ERROR;
}
EXPORT int fmi3SetFloat64(void *c, const Reference r[], size_t n, const double v[], size_t m)
{
    return n == m && !set(c, r, n, v) ? OK : ERROR;
}
EXPORT int fmi3GetFMUState(void *c, void **state)
{
    return save(c, state);
}
EXPORT int fmi3SetFMUState(void *c, void *state) { return memcpy(c, state, sizeof(Table)), OK; }
EXPORT int fmi3FreeFMUState(void *c, void **state)
{
    return UNUSED(c), discard(state);
}
EXPORT int fmi3DoStep(void *c, double time, double size, bool final, bool *event, bool *stop, bool *early, double *last)
{
    UNUSED(final);
    step(c, time + size);
    *event = *stop = *early = false;
    *last = time + size;
    return OK;
}

/* Not needed: no other types, clocks, states or derivatives. */
EXPORT void *fmi3InstantiateModelExchange() { return NULL; }
EXPORT void *fmi3InstantiateScheduledExecution() { return NULL; }
WITHOUT(fmi3ActivateModelPartition)
WITHOUT(fmi3CompletedIntegratorStep)
WITHOUT(fmi3DeserializeFMUState)
WITHOUT(fmi3EnterContinuousTimeMode)
WITHOUT(fmi3EnterEventMode)
WITHOUT(fmi3EvaluateDiscreteStates)
WITHOUT(fmi3GetAdjointDerivative)
WITHOUT(fmi3GetBinary)
WITHOUT(fmi3GetBoolean)
WITHOUT(fmi3GetClock)
WITHOUT(fmi3GetContinuousStateDerivatives)
WITHOUT(fmi3GetContinuousStates)
WITHOUT(fmi3GetDirectionalDerivative)
WITHOUT(fmi3GetEventIndicators)
WITHOUT(fmi3GetFloat32)
WITHOUT(fmi3GetInt16)
WITHOUT(fmi3GetInt32)
WITHOUT(fmi3GetInt64)
WITHOUT(fmi3GetInt8)
WITHOUT(fmi3GetIntervalDecimal)
WITHOUT(fmi3GetIntervalFraction)
WITHOUT(fmi3GetNominalsOfContinuousStates)
WITHOUT(fmi3GetNumberOfContinuousStates)
WITHOUT(fmi3GetNumberOfEventIndicators)
WITHOUT(fmi3GetNumberOfVariableDependencies)
WITHOUT(fmi3GetOutputDerivatives)
WITHOUT(fmi3GetShiftDecimal)
WITHOUT(fmi3GetShiftFraction)
WITHOUT(fmi3GetString)
WITHOUT(fmi3GetUInt16)
WITHOUT(fmi3GetUInt32)
WITHOUT(fmi3GetUInt64)
WITHOUT(fmi3GetUInt8)
WITHOUT(fmi3GetVariableDependencies)
WITHOUT(fmi3SerializeFMUState)
WITHOUT(fmi3SerializedFMUStateSize)
WITHOUT(fmi3SetBinary)
WITHOUT(fmi3SetBoolean)
WITHOUT(fmi3SetClock)
WITHOUT(fmi3SetContinuousStates)
WITHOUT(fmi3SetFloat32)
WITHOUT(fmi3SetInt16)
WITHOUT(fmi3SetInt32)
WITHOUT(fmi3SetInt64)
WITHOUT(fmi3SetInt8)
WITHOUT(fmi3SetIntervalDecimal)
WITHOUT(fmi3SetIntervalFraction)
WITHOUT(fmi3SetShiftDecimal)
WITHOUT(fmi3SetShiftFraction)
WITHOUT(fmi3SetString)
WITHOUT(fmi3SetTime)
WITHOUT(fmi3SetUInt16)
WITHOUT(fmi3SetUInt32)
WITHOUT(fmi3SetUInt64)
WITHOUT(fmi3SetUInt8)
WITHOUT(fmi3UpdateDiscreteStates)
