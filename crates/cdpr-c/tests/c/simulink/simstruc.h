/* As much of Simulink's simstruc.h as cdpr_sfun.c uses, for tests without Simulink. */
#ifndef SIMSTRUC_H
#define SIMSTRUC_H
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef int int_T;

typedef struct {
    const char *text;
    const double *values;
    size_t count;
} mxArray;

typedef struct {
    const mxArray *parameters[3];
    int expected, given;
    const char *error;
    int inputs[2], outputs[3];
    double *input[2], *output[3];
    double sample_time;
    void *works[2], **work;
} SimStruct;

static inline int mxIsChar(const mxArray *array) { return array->text != NULL; }
static inline int mxIsDouble(const mxArray *array) { return array->values != NULL; }
static inline size_t mxGetNumberOfElements(const mxArray *array) { return array->count; }
static inline double *mxGetPr(const mxArray *array) { return (double *)array->values; }
static inline double mxGetScalar(const mxArray *array) { return array->values[0]; }
static inline void mxFree(void *pointer) { free(pointer); }
static inline char *mxArrayToString(const mxArray *array)
{
    char *text = (char *)malloc(strlen(array->text) + 1);
    return text == NULL ? NULL : strcpy(text, array->text);
}

#define ssGetSFcnParam(S, i) ((S)->parameters[i])
#define ssSetErrorStatus(S, text) ((S)->error = (text))
#define ssSetNumSFcnParams(S, n) ((S)->expected = (n))
#define ssGetNumSFcnParams(S) ((S)->expected)
#define ssGetSFcnParamsCount(S) ((S)->given)
#define ssSetSFcnParamTunable(S, i, tunable) ((void)(S), (void)(i), (void)(tunable))
#define ssSetNumInputPorts(S, n) ((void)(S), (n) == 2)
#define ssSetNumOutputPorts(S, n) ((void)(S), (n) == 3)
#define ssSetInputPortWidth(S, i, n) ((S)->inputs[i] = (n))
#define ssGetInputPortWidth(S, i) ((S)->inputs[i])
#define ssSetOutputPortWidth(S, i, n) ((S)->outputs[i] = (n))
#define ssSetInputPortDirectFeedThrough(S, i, is) ((void)(S), (void)(i), (void)(is))
#define ssSetInputPortRequiredContiguous(S, i, is) ((void)(S), (void)(i), (void)(is))
#define ssGetInputPortRealSignal(S, i) ((const double *)(S)->input[i])
#define ssGetOutputPortRealSignal(S, i) ((S)->output[i])
#define ssSetNumSampleTimes(S, n) ((void)(S), (void)(n))
#define ssSetSampleTime(S, i, time) ((void)(i), (S)->sample_time = (time))
#define ssSetOffsetTime(S, i, time) ((void)(S), (void)(i), (void)(time))
#define ssSetNumPWork(S, n) ((S)->work = (n) == 2 ? (S)->works : NULL)
#define ssGetPWork(S) ((S)->work)
#define ssGetPWorkValue(S, i) ((S)->work[i])
#define ssSetPWorkValue(S, i, pointer) ((S)->work[i] = (pointer))

#endif
