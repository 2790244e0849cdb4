/* Tensor product of B-splines over a grid of inputs, held at its ends outside. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "table_data.h" /* INPUTS, OUTPUTS, DEGREE, SIZE, LOW, HIGH, START, KNOTS, COEFFICIENTS, LOG_IN, LOG_OUT, TOKEN */

#define ORDER 4 /* of the splines at most: degree 3 */
/* references of the variables: time 0, inputs from 1, outputs behind them, then `outside` */
#define FIRST_OUTPUT (INPUTS + 1)
#define OUTSIDE (INPUTS + OUTPUTS + 1)
#define VARIABLES (OUTSIDE + 1)

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

typedef unsigned int Reference;
enum { OK, WARNING, DISCARD, ERROR, FATAL };
#define UNUSED(x) (void)(x)
/* A function that a unit must have and this one does not need. */
#define WITHOUT(name)                                                                                      \
    EXPORT int name() { return ERROR; }

typedef struct {
    double value[VARIABLES];
    int current; /* outputs belong to the inputs */
} Table;

/* Index of the knot span of x, and the basis functions that are not zero there (de Boor 1978, X). */
static int basis(int axis, double x, double *values)
{
    const double *t = KNOTS[axis];
    const int k = DEGREE[axis];
    int low = k, high = SIZE[axis], span, j, r;
    double left[ORDER], right[ORDER];
    while (high - low > 1) {
        span = (low + high) / 2;
        if (x < t[span])
            high = span;
        else
            low = span;
    }
    span = low;
    values[0] = 1.0;
    for (j = 1; j <= k; j++) {
        double saved = 0.0;
        left[j] = x - t[span + 1 - j];
        right[j] = t[span + j] - x;
        for (r = 0; r < j; r++) {
            const double term = values[r] / (right[r + 1] + left[j - r]);
            values[r] = saved + right[r + 1] * term;
            saved = left[j - r] * term;
        }
        values[j] = saved;
    }
    return span - k;
}

static void evaluate(Table *table)
{
    double values[INPUTS][ORDER];
    int start[INPUTS], count[INPUTS], axis, m;
    double *out = table->value + FIRST_OUTPUT;
    double outside = 0.0;
    for (axis = 0; axis < INPUTS; axis++) {
        double x = table->value[1 + axis];
        if (!(x >= LOW[axis] && x <= HIGH[axis])) {
            outside = 1.0;
            x = x > HIGH[axis] ? HIGH[axis] : LOW[axis];
        }
        start[axis] = basis(axis, LOG_IN[axis] ? log(x) : x, values[axis]);
        count[axis] = 0;
    }
    for (m = 0; m < OUTPUTS; m++)
        out[m] = 0.0;
    for (;;) { /* over the coefficients that are not multiplied by zero */
        double weight = 1.0;
        size_t place = 0;
        for (axis = 0; axis < INPUTS; axis++) {
            weight *= values[axis][count[axis]];
            place = place * SIZE[axis] + start[axis] + count[axis];
        }
        for (m = 0; m < OUTPUTS; m++)
            out[m] += weight * COEFFICIENTS[place * OUTPUTS + m];
        for (axis = INPUTS - 1; axis >= 0; axis--) {
            if (++count[axis] <= DEGREE[axis])
                break;
            count[axis] = 0;
        }
        if (axis < 0)
            break;
    }
    for (m = 0; m < OUTPUTS; m++)
        if (LOG_OUT[m])
            out[m] = exp(out[m]);
    table->value[OUTSIDE] = outside;
    table->current = 1;
}

static void reset(Table *table)
{
    memset(table->value, 0, sizeof table->value);
    memcpy(table->value + 1, START, sizeof START);
    table->current = 0;
}

static Table *create(const char *token)
{
    Table *table = token && strcmp(token, TOKEN) == 0 ? malloc(sizeof(Table)) : NULL;
    if (table)
        reset(table);
    return table;
}

static int get(Table *table, const unsigned int *references, size_t n, double *values)
{
    size_t i;
    if (!table->current)
        evaluate(table);
    for (i = 0; i < n; i++) {
        if (references[i] >= VARIABLES)
            return 1;
        values[i] = table->value[references[i]];
    }
    return 0;
}

static int set(Table *table, const unsigned int *references, size_t n, const double *values)
{
    size_t i;
    for (i = 0; i < n; i++) {
        if (references[i] < 1 || references[i] > INPUTS)
            return 1;
        table->value[references[i]] = values[i];
    }
    table->current = 0;
    return 0;
}

static void step(Table *table, double time)
{
    table->value[0] = time;
    table->current = 0;
}

static int save(const Table *table, void **state)
{
    if (!*state && !(*state = malloc(sizeof(Table))))
        return ERROR;
    memcpy(*state, table, sizeof(Table));
    return OK;
}

static int discard(void **state)
{
    free(*state);
    *state = NULL;
    return OK;
}
