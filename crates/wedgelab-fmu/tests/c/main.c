/* Loads the library of an FMU as an importer does, and calls every function of FMI 2.0 or 3.0, in order and out of order.
 *
 * usage: check 2|3 LIBRARY RESOURCES TOKEN VARIABLES CORRUPTIONS
 *
 * RESOURCES is a URI for FMI 2.0 and a path for FMI 3.0; VARIABLES is a file with lines "name reference". Prints the outputs of a
 * short run as "result" with hexadecimal numbers, for comparison with other importers. */
#include "check.h"

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

long messages, failures, expectations;
const Api *api;
const char *token, *resources;
size_t state_count, indicator_count;

static struct {
    char name[96];
    uint32_t reference;
} variables[1000];
static size_t variable_count;

void expect(int holds, const char *what, const char *file, int line) {
    expectations += 1;
    if (!holds) {
        failures += 1;
        fprintf(stderr, "%s:%d: not so: %s\n", file, line, what);
    }
}

uint32_t reference(const char *name) {
    for (size_t i = 0; i < variable_count; i += 1) {
        if (strcmp(variables[i].name, name) == 0) return variables[i].reference;
    }
    fprintf(stderr, "there is no variable %s\n", name);
    exit(2);
}

void *room(size_t bytes) {
    void *memory = malloc(bytes ? bytes : 1);
    if (!memory) exit(2);
    memset(memory, 0x5a, bytes);
    return memory;
}

static void read_variables(const char *path) {
    FILE *file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "%s cannot be opened\n", path);
        exit(2);
    }
    while (variable_count < 1000 &&
           fscanf(file, "%95s %u", variables[variable_count].name, &variables[variable_count].reference) == 2) {
        const char *name = variables[variable_count].name;
        state_count += strncmp(name, "der(", 4) == 0;
        size_t length = strlen(name), ending = strlen("_event_indicator");
        indicator_count += length > ending && strcmp(name + length - ending, "_event_indicator") == 0;
        variable_count += 1;
    }
    fclose(file);
}

void *made(int exchange) {
    void *instance = api->instantiate(exchange, "wedge", token, resources);
    if (!instance) {
        fprintf(stderr, "no instance could be made\n");
        exit(2);
    }
    return instance;
}

void *started(int exchange) {
    void *instance = made(exchange);
    EXPECT(api->enter_initialization(instance) == OK);
    EXPECT(api->exit_initialization(instance) == OK);
    return instance;
}

void drive(void *instance, int first, int last, double amplitude, double *out) {
    const uint32_t in[2] = {reference("bolster_z"), reference("bolster_z_rate")};
    const uint32_t outputs[6] = {reference("force_on_bolster_x"),      reference("force_on_bolster_z"),
                                 reference("moment_on_bolster_yaw"),   reference("force_on_side_frame_z"),
                                 reference("side_frame_friction_loss"), reference("coil_force")};
    for (int k = first; k < last; k += 1) {
        double time = k * 1e-3;
        /* A parabola up and down: the same bits with every importer. */
        double values[2] = {amplitude * time * (1.0 - 4.0 * time), amplitude * (1.0 - 8.0 * time)};
        EXPECT(api->set(instance, in, 2, values) == OK);
        EXPECT(api->step(instance, time, 1e-3) == OK);
    }
    EXPECT(api->get(instance, outputs, 6, out) == OK);
}

static void run(void) {
    void *instance = started(0);
    double out[6];
    drive(instance, 0, 60, 0.05, out);
    printf("result");
    for (int i = 0; i < 6; i += 1) {
        EXPECT(isfinite(out[i]));
        printf(" %a", out[i]);
    }
    printf("\n");
    EXPECT(api->terminate(instance) == OK);
    api->free_instance(instance);
}

int main(int count, char **arguments) {
    if (count != 7) {
        fprintf(stderr, "usage: check 2|3 LIBRARY RESOURCES TOKEN VARIABLES CORRUPTIONS\n");
        return 2;
    }
    void *library = dlopen(arguments[2], RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        return 2;
    }
    api = arguments[1][0] == '2' ? load_fmi2(library) : load_fmi3(library);
    resources = arguments[3];
    token = arguments[4];
    read_variables(arguments[5]);
    run();
    check_nobody();
    check_instantiation();
    check_phases(0);
    check_phases(1);
    check_values();
    check_steps();
    check_states(atoi(arguments[6]));
    check_derivatives();
    check_instances();
    api->others();
    api->uncalled();
    printf("%ld expectations, %ld not met, %ld messages\n", expectations, failures, messages);
    return failures ? 1 : 0;
}
