/* Drives a fuzz target without a fuzzer. Each file named on the command line is given whole, cut
   at every byte, and with every byte replaced by each of some nasty ones. Copies are exactly as
   long as their content, so that the sanitizers see a read behind the end. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void give(const uint8_t *data, size_t size) {
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy) exit(1);
    if (size) memcpy(copy, data, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

static long replay(uint8_t *data, size_t size) {
    static const uint8_t nasty[] = {0, '\n', '\r', ' ', '-', '.', '0', '9', 'e', '{', 255};
    long runs = 1;
    give(data, size);
    for (size_t i = 0; i < size; i++, runs++) give(data, i);
    for (size_t i = 0; i < size; i++) {
        uint8_t old = data[i];
        for (size_t k = 0; k < sizeof nasty; k++, runs++) {
            data[i] = nasty[k];
            give(data, size);
        }
        data[i] = old;
    }
    return runs;
}

int main(int argc, char **argv) {
    enum { MOST = 1 << 20 };
    for (int i = 1; i < argc; i++) {
        FILE *f = fopen(argv[i], "rb");
        uint8_t *data = malloc(MOST);
        if (!f || !data) {
            perror(argv[i]);
            return 1;
        }
        size_t size = fread(data, 1, MOST, f);
        fclose(f);
        printf("%s: %ld runs\n", argv[i], replay(data, size));
        free(data);
    }
    return 0;
}
