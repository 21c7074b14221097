#pragma once

#include <peregrine/rt.h>

#include <stddef.h>
#include <stdio.h>

#define STRUCT(type) printf("struct %s %zu\n", #type, sizeof(type))
#define FIELD(type, field)                                                                         \
    printf("%s.%s %zu %zu\n", #type, #field, offsetof(type, field), sizeof(((type*)0)->field))

void print_programs(void);
void print_looks(void);
void print_shapes(void);
void print_lights(void);
void print_commit(void);
void print_query(void);
void print_sweeps(void);
void print_frame(void);
