// locusd: stands in until the threads do.
int main() { return 0; }
